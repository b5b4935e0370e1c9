// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_tree.h"

#include <algorithm>
#include <utility>

namespace palpate::node {

using XmlRpc::XmlRpcValue;

namespace {

XmlRpcValue valuesBelow(const ros::NodeHandle& handle) {
  XmlRpcValue values;
  handle.getParam(handle.getNamespace(), values);
  return values;
}

void addKeys(const XmlRpcValue& values, const std::string& before, std::vector<std::string>* keys) {
  for (const auto& [name, value] : values) {
    const std::string key = before + name;
    if (value.getType() == XmlRpcValue::TypeStruct) {
      addKeys(value, key + "/", keys);
    } else {
      keys->push_back(key);
    }
  }
}

}  // namespace

ParamTree::ParamTree(const ros::NodeHandle& handle)
    : ParamTree(handle.getNamespace(), valuesBelow(handle)) {}

ParamTree::ParamTree(std::string name, XmlRpcValue values)
    : name_(std::move(name)), values_(std::move(values)) {}

const XmlRpcValue* ParamTree::find(const std::string& key) const {
  const XmlRpcValue* value = &values_;
  for (std::size_t at = 0; at <= key.size();) {
    const std::size_t end = std::min(key.find('/', at), key.size());
    const std::string part = key.substr(at, end - at);
    if (value->getType() != XmlRpcValue::TypeStruct || !value->hasMember(part)) return nullptr;
    value = &(*value)[part];
    at = end + 1;
  }
  return value;
}

std::vector<std::string> ParamTree::keys() const {
  std::vector<std::string> all;
  if (values_.getType() == XmlRpcValue::TypeStruct) addKeys(values_, "", &all);
  return all;
}

}  // namespace palpate::node
