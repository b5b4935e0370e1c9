// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_file.h"

#include <algorithm>

#include "scalar_type.h"

namespace palpate::formats {
namespace {

constexpr int kGmshTet4 = 4, kGmshTet10 = 11;

// Nodes of Gmsh's element types 1 ... 31 [Gmsh reference manual, MSH file format].
constexpr int kNodes[] = {0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                          8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
// 64 and 125 nodes: hexahedra of order 3 and 4.
constexpr int kHexahedron64 = 92, kHexahedron125 = 93;
constexpr int kOtherGmshElements[] = {5, 6, 7, 12, 13, 14, 17, 18, 19, 29, 30, 31, 92, 93};

}  // namespace

std::int64_t TagIndex::findRising(std::int64_t tag) const {
  if (rising_.empty() || tag < rising_.front().first || tag > rising_.back().first) return -1;
  // Without gaps the tag gives the position.
  const auto place =
      static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(rising_.front().first);
  if (place < rising_.size() && rising_[place].first == tag) return rising_[place].second;
  const auto found =
      std::lower_bound(rising_.begin(), rising_.end(), std::make_pair(tag, std::int64_t{0}));
  return found->first == tag ? found->second : -1;
}

std::int64_t TagIndex::find(std::int64_t tag) const {
  const std::int64_t index = findRising(tag);
  if (index >= 0 || others_.empty()) return index;
  const auto found = others_.find(tag);
  return found == others_.end() ? -1 : found->second;
}

bool TagIndex::add(std::int64_t tag, std::int64_t index) {
  if (find(tag) >= 0) return false;
  if (rising_.empty() || tag > rising_.back().first) {
    rising_.emplace_back(tag, index);
  } else {
    others_.emplace(tag, index);
  }
  return true;
}

int GmshFile::integer(const char* what) {
  if (!binary) return in.smallInteger(what);
  return load<std::int32_t>(in.bytes(4, what).data(), swap);
}

std::int64_t GmshFile::size(const char* what) {
  if (!binary) return in.integer(what);
  if (size_of_size == 4) return load<std::uint32_t>(in.bytes(4, what).data(), swap);
  return load<std::int64_t>(in.bytes(8, what).data(), swap);
}

double GmshFile::real(const char* what) {
  if (!binary) return in.number(what);
  return load<double>(in.bytes(8, what).data(), swap);
}

std::size_t GmshFile::count(const char* what, std::size_t bytes_in_text,
                            std::size_t bytes_in_binary) {
  const std::int64_t n = size(what);
  in.checkCount(n, what, binary ? bytes_in_binary : bytes_in_text);
  return static_cast<std::size_t>(n);
}

void GmshFile::addNode(std::int64_t tag, const Vec3& point) {
  const auto next = static_cast<std::int64_t>(builder.numPoints());
  if (!index_.add(tag, next)) {
    in.fail("node " + std::to_string(tag), "must not come twice");
  }
  builder.addPoint(point);
}

int GmshFile::numNodes(int type) const {
  if (type >= 1 && type < static_cast<int>(std::size(kNodes))) return kNodes[type];
  if (type == kHexahedron64) return 64;
  if (type == kHexahedron125) return 125;
  in.fail("element type " + std::to_string(type), "must be one of Gmsh's 1 to 31, 92, 93");
}

void GmshFile::addElement(int type, const NodeTags& tags, int region) {
  if (std::count(std::begin(kOtherGmshElements), std::end(kOtherGmshElements), type) > 0) {
    in.fail("element type " + std::to_string(type),
            "volume elements must be tetrahedra with 4 nodes (type 4) or 10 nodes (type 11)");
  }
  if (type != kGmshTet4 && type != kGmshTet10) return;
  TetNodes nodes{};
  const int num_nodes = numNodes(type);
  for (int i = 0; i < num_nodes; ++i) {
    nodes[i] = index_.find(tags[i]);
    if (nodes[i] >= 0) continue;
    in.fail("node " + std::to_string(tags[i]), "an element has a node that is not in the file");
  }
  // Gmsh's edges are 01 12 20 03 23 13; VTK's last two are the other way round.
  if (type == kGmshTet10) std::swap(nodes[8], nodes[9]);
  builder.addTet(nodes, num_nodes);
  builder.setRegion(region);
}

}  // namespace palpate::formats
