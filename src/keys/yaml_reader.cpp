// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/keys/yaml_reader.h"

#include "yaml_node.h"
#include "yaml_visitor.h"

namespace palpate::keys {

void readYaml(const std::string& file, const std::function<void(FieldVisitor&)>& fields) {
  const YAML::Node root = readYamlMap(file);
  std::vector<Problem> problems;
  try {
    YamlVisitor visitor(root);
    fields(visitor);
    problems = visitor.finish();
  } catch (const YAML::Exception& e) {  // a node of an unexpected type
    throw InputError(file, "line " + std::to_string(e.mark.line + 1), "", e.msg);
  }
  if (!problems.empty()) throw InputError(file, problems);
}

}  // namespace palpate::keys
