// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "gmsh_file.h"
#include "scalar_type.h"
#include "tet_formats.h"

namespace palpate::formats {
namespace {

/// Sections to read, by name and major version. Others are skipped.
struct Section {
  const char* name;
  int version;
  void (*read)(GmshFile&);
  const char* end;
};
constexpr Section kSections[] = {{"$NOD", 1, readGmsh1Nodes, "$ENDNOD"},
                                 {"$ELM", 1, readGmsh1Elements, "$ENDELM"},
                                 {"$Nodes", 2, readGmsh2Nodes, "$EndNodes"},
                                 {"$Elements", 2, readGmsh2Elements, "$EndElements"},
                                 {"$Entities", 4, readGmsh4Entities, "$EndEntities"},
                                 {"$Nodes", 4, readGmsh4Nodes, "$EndNodes"},
                                 {"$Elements", 4, readGmsh4Elements, "$EndElements"}};

/// Reads "4.1 1 8", and in a binary file the integer 1 in its byte order. Returns the major
/// version.
int readFormat(GmshFile& f) {
  const std::string_view version = f.in.word();
  const double number = f.in.toNumber(version, "version");
  if (!(number >= 2.0 && number < 3.0) && number != 4.1) {
    f.in.fail(version, "the version must be 1, 2.x or 4.1");
  }
  const std::int64_t kind = f.in.integer("file type");
  if (kind != 0 && kind != 1) f.in.fail(std::to_string(kind), "the file type must be 0 or 1");
  f.size_of_size = f.in.smallInteger("data size");
  if (f.size_of_size != 8 && !(number == 4.1 && f.size_of_size == 4)) {
    f.in.fail(std::to_string(f.size_of_size), "the data size must be 8");
  }
  f.in.skipLine();
  f.binary = kind == 1;
  if (f.binary) {
    const char* one = f.in.bytes(4, "the number 1 of a binary file").data();
    f.swap = load<std::int32_t>(one, false) != 1;
    if (load<std::int32_t>(one, f.swap) != 1) {
      f.in.fail("", "a binary file must have the integer 1 here");
    }
  }
  f.in.expect("$EndMeshFormat");
  return static_cast<int>(number);
}

void readSection(const std::string& name, int version, GmshFile& f) {
  bool known = false;
  for (const Section& section : kSections) {
    if (name != section.name) continue;
    known = true;
    if (section.version != version) continue;
    section.read(f);
    f.in.expect(section.end);
    return;
  }
  if (known) {
    f.in.fail(name, version == 1 ? "must stand behind $MeshFormat"
                                 : "no section of version " + std::to_string(version));
  }
  f.in.skipPast("$End" + name.substr(1));
}

}  // namespace

mesh::TetMesh readMsh(const std::string& file, std::string_view bytes) {
  GmshFile f(file, bytes);
  int version = 1;  // version 1 has no $MeshFormat
  while (!f.in.atEnd()) {
    const std::string name(f.in.word());
    if (name[0] != '$') f.in.fail(name, "must be the name of a section: $MeshFormat, $NOD, ...");
    if (name == "$MeshFormat") {
      version = readFormat(f);
    } else {
      readSection(name, version, f);
    }
  }
  return f.builder.finish();
}

}  // namespace palpate::formats
