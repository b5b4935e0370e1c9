// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cursor.h"
#include "tet_builder.h"

namespace palpate::formats {

/// Which node has a tag. Takes the logarithm of their number for any tags, which a table of hashes
/// would not: a file chooses them.
class TagIndex {
 public:
  /// False if there is one of that tag.
  bool add(std::int64_t tag, std::int64_t index);
  /// -1: none.
  std::int64_t find(std::int64_t tag) const;

 private:
  std::int64_t findRising(std::int64_t tag) const;

  std::vector<std::pair<std::int64_t, std::int64_t>> rising_;  // most files have no others
  std::map<std::int64_t, std::int64_t> others_;
};

/// What the sections of a .msh file share while it is read.
class GmshFile {
 public:
  static constexpr std::size_t kMostNodes = 125;
  using NodeTags = std::array<std::int64_t, kMostNodes>;

  GmshFile(const std::string& file, std::string_view bytes) : in(file, bytes), builder(file) {}

  Cursor in;
  TetBuilder builder;
  bool binary = false;
  bool swap = false;            // the file has the other byte order
  int size_of_size = 8;         // [bytes] of size_t in version 4
  std::map<int, int> physical;  // version 4: tag of a volume to its physical tag

  // The next number, in text or binary.
  int integer(const char* what);
  std::int64_t size(const char* what);
  double real(const char* what);
  /// A number of things, each of at least so many bytes; as Cursor::count().
  std::size_t count(const char* what, std::size_t bytes_in_text, std::size_t bytes_in_binary);

  void addNode(std::int64_t tag, const Vec3& point);
  /// An element of Gmsh's `type` with the tags of its nodes in Gmsh's order. Tetrahedra are kept,
  /// other volumes refused, everything else ignored.
  void addElement(int type, const NodeTags& tags, int region);
  /// Nodes of an element of `type`; unknown types are refused.
  int numNodes(int type) const;

 private:
  TagIndex index_;
};

// The sections, from behind their name up to their end mark.
void readGmsh1Nodes(GmshFile& f);     // $NOD
void readGmsh1Elements(GmshFile& f);  // $ELM
void readGmsh2Nodes(GmshFile& f);     // $Nodes of version 2
void readGmsh2Elements(GmshFile& f);  // $Elements of version 2
void readGmsh4Entities(GmshFile& f);  // $Entities of version 4.1
void readGmsh4Nodes(GmshFile& f);     // $Nodes of version 4.1
void readGmsh4Elements(GmshFile& f);  // $Elements of version 4.1

}  // namespace palpate::formats
