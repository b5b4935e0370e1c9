// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

#include "gmsh_file.h"

namespace palpate::formats {
namespace {

int readDimension(GmshFile& f) {
  const int dimension = f.integer("dimension of an entity");
  if (dimension >= 0 && dimension <= 3) return dimension;
  f.in.fail(std::to_string(dimension), "the dimension of an entity must be 0 ... 3");
}

/// Reads an entity: tag, extent (x y z for a point, else two corners), physical tags, and bounding
/// entities except for points.
void readEntity(GmshFile& f, int dimension) {
  const int tag = f.integer("tag of an entity");
  for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) f.real("extent of an entity");
  int physical = 0;
  for (std::size_t n = f.count("number of physical tags", 2, 4), i = 0; i < n; ++i) {
    const int p = f.integer("physical tag");
    // A negative tag means reversed orientation. The most negative int has no absolute value.
    if (i == 0) physical = std::abs(std::max(p, -std::numeric_limits<int>::max()));
  }
  if (dimension == 3 && physical != 0) f.physical[tag] = physical;
  if (dimension == 0) return;
  for (std::size_t n = f.count("number of bounding entities", 2, 4); n > 0; --n) {
    f.integer("bounding entity");
  }
}

}  // namespace

void readGmsh4Entities(GmshFile& f) {
  if (f.binary) f.in.skipLine();
  std::size_t counts[4];
  for (std::size_t& n : counts) n = f.count("number of entities", 6, 28);
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t n = counts[dimension]; n > 0; --n) readEntity(f, dimension);
  }
}

void readGmsh4Nodes(GmshFile& f) {
  if (f.binary) f.in.skipLine();
  const std::size_t num_blocks = f.count("number of node blocks", 8, 12);
  std::size_t left = f.count("number of nodes", 8, 24);
  f.size("smallest node tag");
  f.size("largest node tag");
  std::vector<std::int64_t> tags;
  for (std::size_t block = 0; block < num_blocks; ++block) {
    const int dimension = readDimension(f);
    f.integer("tag of an entity");
    const bool parametric = f.integer("parametric") != 0;
    const std::size_t n = f.count("number of nodes in a block", 8, 24);
    if (n > left) f.in.fail(std::to_string(n), "more nodes than the section announced");
    left -= n;
    tags.resize(n);
    for (std::int64_t& tag : tags) tag = f.size("tag of a node");
    for (const std::int64_t tag : tags) {
      const double x = f.real("x of a node");
      const double y = f.real("y of a node");
      const double z = f.real("z of a node");
      for (int i = 0; i < (parametric ? dimension : 0); ++i) f.real("parameter of a node");
      f.addNode(tag, Vec3(x, y, z));
    }
  }
  if (left > 0) f.in.fail(std::to_string(left) + " nodes", "fewer than the section announced");
}

void readGmsh4Elements(GmshFile& f) {
  if (f.binary) f.in.skipLine();
  const std::size_t num_blocks = f.count("number of element blocks", 8, 12);
  std::size_t left = f.count("number of elements", 4, 8);
  f.size("smallest element tag");
  f.size("largest element tag");
  GmshFile::NodeTags nodes{};
  for (std::size_t block = 0; block < num_blocks; ++block) {
    const int dimension = readDimension(f);
    const int tag = f.integer("tag of an entity");
    const int type = f.integer("type of elements");
    const std::size_t n = f.count("number of elements in a block", 4, 8);
    if (n > left) f.in.fail(std::to_string(n), "more elements than the section announced");
    left -= n;
    const auto physical = dimension == 3 ? f.physical.find(tag) : f.physical.end();
    const int region = physical == f.physical.end() ? tag : physical->second;
    const int num_nodes = f.numNodes(type);
    for (std::size_t e = 0; e < n; ++e) {
      f.size("tag of an element");
      for (int i = 0; i < num_nodes; ++i) nodes[i] = f.size("node of an element");
      f.addElement(type, nodes, region);
    }
  }
  if (left > 0) f.in.fail(std::to_string(left) + " elements", "fewer than the section announced");
}

}  // namespace palpate::formats
