// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "palpate/keys/fields.h"
#include "palpate/scene/scene.h"

namespace palpate::node {

/// Which palpate_node, and its scene: parameters of programs that play into it and record it.
struct NodeSceneParams {
  std::string node = "palpate";  ///< ~node: its name.
  std::string scene;             ///< ~scene: a file or a name; "": the parameter of that node.
};

void describe(keys::FieldVisitor& v, NodeSceneParams& params);

/// The name of the node in the graph, "/palpate".
std::string nodeName(const NodeSceneParams& params);

/// The scene's file.
/// @throws InputError: neither ~scene nor the node's is set, or no such scene.
std::string nodeSceneFile(const NodeSceneParams& params);

/// The scene with the keys that parameters of the node replace.
/// @throws InputError
scene::Scene readNodeScene(const NodeSceneParams& params);

}  // namespace palpate::node
