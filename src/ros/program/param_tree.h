// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

namespace palpate::node {

/// The parameters below a name, as they are when it is made. Keys are relative to that name, with
/// "/" between their parts.
class ParamTree {
 public:
  ParamTree() = default;
  /// Of the parameter server, below the handle's namespace.
  explicit ParamTree(const ros::NodeHandle& handle);
  /// `values`: a structure, or nothing. `name` is for messages.
  ParamTree(std::string name, XmlRpc::XmlRpcValue values);

  const std::string& name() const { return name_; }
  /// What is set at the key, a structure if keys are set below it; none: nullptr.
  const XmlRpc::XmlRpcValue* find(const std::string& key) const;
  /// All that are set, without those below which others are.
  std::vector<std::string> keys() const;

 private:
  std::string name_;
  XmlRpc::XmlRpcValue values_;
};

}  // namespace palpate::node
