// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_file.h"

namespace palpate::formats {

void readGmsh1Nodes(GmshFile& f) {
  for (std::size_t n = f.in.count("number of nodes", 8); n > 0; --n) {
    const std::int64_t tag = f.in.integer("tag of a node");
    const double x = f.in.number("x of a node");
    const double y = f.in.number("y of a node");
    const double z = f.in.number("z of a node");
    f.addNode(tag, Vec3(x, y, z));
  }
}

void readGmsh1Elements(GmshFile& f) {
  GmshFile::NodeTags tags{};
  for (std::size_t n = f.in.count("number of elements", 12); n > 0; --n) {
    f.in.integer("tag of an element");
    const int type = f.in.smallInteger("type of an element");
    const int physical = f.in.smallInteger("physical tag of an element");
    const int elementary = f.in.smallInteger("elementary tag of an element");
    const int num_nodes = f.numNodes(type);
    if (f.in.integer("number of an element's nodes") != num_nodes) {
      f.in.fail("", "an element of type " + std::to_string(type) + " must have " +
                        std::to_string(num_nodes) + " nodes");
    }
    for (int i = 0; i < num_nodes; ++i) tags[i] = f.in.integer("node of an element");
    f.addElement(type, tags, physical != 0 ? physical : elementary);
  }
}

}  // namespace palpate::formats
