// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_scene.h"

#include <ros/names.h>

#include "palpate/base/error.h"
#include "params.h"
#include "ros/program/param_tree.h"
#include "shipped.h"

namespace palpate::node {

void describe(keys::FieldVisitor& v, NodeSceneParams& p) {
  v.text({"node", "", "Name of the palpate_node."}, p.node);
  v.text({kSceneParam, "", "Its scene, a file or a name; if not given, that of its parameter."},
         p.scene);
  v.rule(!p.node.empty(), "node", "must be the name of a node");
}

std::string nodeName(const NodeSceneParams& params) { return ros::names::resolve(params.node); }

std::string nodeSceneFile(const NodeSceneParams& params) {
  std::string scene = params.scene;
  if (scene.empty()) ros::NodeHandle(nodeName(params)).getParam(kSceneParam, scene);
  if (scene.empty()) {
    throw InputError("parameters of " + ros::NodeHandle("~").getNamespace(), kSceneParam, "",
                     "must be a scene: " + nodeName(params) + " has none, is it running?");
  }
  return start::sceneFile(scene);
}

scene::Scene readNodeScene(const NodeSceneParams& params) {
  return readScene(nodeSceneFile(params), ParamTree(ros::NodeHandle(nodeName(params))));
}

}  // namespace palpate::node
