// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>

#include "cursor.h"
#include "palpate/base/number.h"
#include "tet_builder.h"
#include "tet_formats.h"

namespace palpate::formats {
namespace {

constexpr std::string_view kOtherSections[] = {"Hexahedra", "Prisms", "Pyramids", "HexahedraP2",
                                               "TetrahedraP3"};

void readVertices(Cursor& in, TetBuilder* builder) {
  if (builder->numPoints() > 0) in.fail("Vertices", "must not come twice");
  for (std::size_t n = in.count("number of vertices", 8); n > 0; --n) {
    const double x = in.number("x of a vertex");
    const double y = in.number("y of a vertex");
    const double z = in.number("z of a vertex");
    in.number("reference of a vertex");
    builder->addPoint(Vec3(x, y, z));
  }
}

/// Mid-edge nodes are in VTK's order.
void readTets(Cursor& in, int num_nodes, TetBuilder* builder) {
  for (std::size_t n = in.count("number of tetrahedra", 10); n > 0; --n) {
    TetNodes nodes{};
    for (int i = 0; i < num_nodes; ++i) {  // counted from 1; the least int has no predecessor
      nodes[i] = std::max(in.integer("node of a tetrahedron"), std::int64_t{0}) - 1;
    }
    builder->addTet(nodes, num_nodes);
    builder->setRegion(in.smallInteger("reference of a tetrahedron"));
  }
}

void readMeshDimension(Cursor& in) {
  if (in.integer("dimension") != 3) in.fail("Dimension", "must be 3");
}

/// Skips the numbers of an unused section.
void skipNumbers(Cursor& in) {
  while (parseNumber(in.peek())) in.word();
}

}  // namespace

mesh::TetMesh readMedit(const std::string& file, std::string_view bytes) {
  Syntax syntax;
  syntax.comment = '#';
  Cursor in(file, bytes, syntax);
  in.expect("MeshVersionFormatted");
  const std::int64_t version = in.integer("version");
  if (version < 1 || version > 3) in.fail(std::to_string(version), "the version must be 1, 2 or 3");
  TetBuilder builder(file);
  while (!in.atEnd()) {
    const std::string_view section = in.word();
    if (section == "End") break;
    if (section == "Dimension") {
      readMeshDimension(in);
    } else if (section == "Vertices") {
      readVertices(in, &builder);
    } else if (section == "Tetrahedra") {
      readTets(in, 4, &builder);
    } else if (section == "TetrahedraP2") {
      readTets(in, 10, &builder);
    } else if (std::count(std::begin(kOtherSections), std::end(kOtherSections), section) > 0) {
      if (in.integer("number of cells") != 0) in.fail(section, "only tetrahedra are read");
    } else if (section[0] >= 'A' && section[0] <= 'Z') {
      skipNumbers(in);
    } else {
      in.fail(section, "must be the name of a section: Vertices, Tetrahedra, ..., End");
    }
  }
  return builder.finish();
}

}  // namespace palpate::formats
