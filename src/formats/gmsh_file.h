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

/// Maps tags to node indices. Logarithmic for any tags; a hash table could be made slow by a file's
/// choice of tags.
class TagIndex {
 public:
  /// Returns false if the tag exists.
  bool add(std::int64_t tag, std::int64_t index);
  /// Index, or -1.
  std::int64_t find(std::int64_t tag) const;

 private:
  std::int64_t findRising(std::int64_t tag) const;

  std::vector<std::pair<std::int64_t, std::int64_t>> rising_;  // increasing tags; most files have
                                                               // no others
  std::map<std::int64_t, std::int64_t> others_;
};

/// Common state of the sections of a .msh file during reading.
class GmshFile {
 public:
  static constexpr std::size_t kMostNodes = 125;
  using NodeTags = std::array<std::int64_t, kMostNodes>;

  GmshFile(const std::string& file, std::string_view bytes) : in(file, bytes), builder(file) {}

  Cursor in;
  TetBuilder builder;
  bool binary = false;
  bool swap = false;            // byte order differs from this machine's
  int size_of_size = 8;         // size_t in version 4 [bytes]
  std::map<int, int> physical;  // version 4: physical tag of each volume

  // Reads the next number, text or binary.
  int integer(const char* what);
  std::int64_t size(const char* what);
  double real(const char* what);
  /// Reads a number of items of at least these sizes, as Cursor::count().
  std::size_t count(const char* what, std::size_t bytes_in_text, std::size_t bytes_in_binary);

  void addNode(std::int64_t tag, const Vec3& point);
  /// Adds an element of Gmsh's `type`, with node tags in Gmsh's order. Keeps tetrahedra, refuses
  /// other volumes, ignores the rest.
  void addElement(int type, const NodeTags& tags, int region);
  /// Number of nodes of an element of `type`; refuses unknown types.
  int numNodes(int type) const;

 private:
  TagIndex index_;
};

// Readers of sections, from after the name to the end mark.
void readGmsh1Nodes(GmshFile& f);     // $NOD
void readGmsh1Elements(GmshFile& f);  // $ELM
void readGmsh2Nodes(GmshFile& f);     // $Nodes of version 2
void readGmsh2Elements(GmshFile& f);  // $Elements of version 2
void readGmsh4Entities(GmshFile& f);  // $Entities of version 4.1
void readGmsh4Nodes(GmshFile& f);     // $Nodes of version 4.1
void readGmsh4Elements(GmshFile& f);  // $Elements of version 4.1

}  // namespace palpate::formats
