// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_file.h"

namespace palpate::formats {
namespace {

/// Region of an element: the first tag is physical, the second elementary.
int readTags(GmshFile& f, int num_tags) {
  int region = 0;
  for (int i = 0; i < num_tags; ++i) {
    const int tag = f.integer("tag of an element");
    if (i == 0 || (i == 1 && region == 0)) region = tag;
  }
  return region;
}

void readElement(GmshFile& f, int type, int num_tags) {
  GmshFile::NodeTags nodes{};
  const int region = readTags(f, num_tags);
  const int num_nodes = f.numNodes(type);
  for (int i = 0; i < num_nodes; ++i) nodes[i] = f.integer("node of an element");
  f.addElement(type, nodes, region);
}

int readNumTags(GmshFile& f) {
  const int n = f.integer("number of an element's tags");
  f.in.checkCount(n, "number of an element's tags", f.binary ? 4 : 2);
  return n;
}

}  // namespace

void readGmsh2Nodes(GmshFile& f) {
  const std::size_t num_nodes = f.in.count("number of nodes", 8);  // 8 bytes in text and binary
  f.in.skipLine();
  for (std::size_t n = num_nodes; n > 0; --n) {
    const int tag = f.integer("tag of a node");
    const double x = f.real("x of a node");
    const double y = f.real("y of a node");
    const double z = f.real("z of a node");
    f.addNode(tag, Vec3(x, y, z));
  }
}

void readGmsh2Elements(GmshFile& f) {
  std::size_t left = f.in.count("number of elements", 8);
  f.in.skipLine();
  while (left > 0) {
    if (!f.binary) {
      f.integer("number of an element");
      const int type = f.integer("type of an element");
      readElement(f, type, readNumTags(f));
      --left;
      continue;
    }
    // Blocks of elements of one type.
    const int type = f.integer("type of elements");
    const int in_block = f.integer("number of elements in a block");
    const int num_tags = readNumTags(f);
    if (in_block < 1 || static_cast<std::size_t>(in_block) > left) {
      f.in.fail(std::to_string(in_block) + " elements in a block",
                "must be 1 ... " + std::to_string(left));
    }
    for (int i = 0; i < in_block; ++i) {
      f.integer("number of an element");
      readElement(f, type, num_tags);
    }
    left -= static_cast<std::size_t>(in_block);
  }
}

}  // namespace palpate::formats
