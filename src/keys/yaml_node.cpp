// SPDX-License-Identifier: GPL-3.0-or-later
#include "yaml_node.h"

#include <cmath>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/base/text_file.h"
#include "yaml_bounds.h"

namespace palpate::keys {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{4} << 20;
constexpr std::size_t kMaxShown = 60;  // characters

std::string shortened(const std::string& text) {
  return text.size() <= kMaxShown ? text : text.substr(0, kMaxShown) + "...";
}

bool isQuoted(const YAML::Node& node) { return node.Tag() == "!"; }

}  // namespace

YAML::Node readYamlMap(const std::string& file) {
  const std::string text = readTextFile(file, kMaxBytes);
  YAML::Node document;
  try {
    checkYamlBounds(file, text);
    document = YAML::Load(text);
  } catch (const YAML::Exception& e) {
    const std::string line = e.mark.is_null() ? "" : "line " + std::to_string(e.mark.line + 1);
    throw InputError(file, line, "", "is not YAML: " + e.msg);
  }
  if (document.IsNull()) throw InputError(file, "", "", "is empty");
  if (!document.IsMap()) {
    throw InputError(file, "", shown(document), "must be keys with values, `key: value`");
  }
  return document;
}

std::optional<YAML::Node> findPath(const YAML::Node& map, const std::string& path) {
  if (!map.IsMap()) return {};
  const std::size_t dot = path.find('.');
  const std::string head = path.substr(0, dot);
  const std::size_t bracket = head.find('[');
  YAML::Node found = map[head.substr(0, bracket)];
  if (found && bracket != std::string::npos) {
    const std::size_t index = std::stoul(head.substr(bracket + 1));
    if (!found.IsSequence() || index >= found.size()) return {};
    found.reset(found[index]);
  }
  if (!found) return {};
  if (dot == std::string::npos) return found;
  return findPath(found, path.substr(dot + 1));
}

std::string lineOf(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? "" : " [line " + std::to_string(mark.line + 1) + "]";
}

std::string shown(const YAML::Node& node) {
  if (node.IsNull()) return "null";
  if (node.IsScalar()) return shortened(isQuoted(node) ? '"' + node.Scalar() + '"' : node.Scalar());
  if (node.IsMap()) return "{...}";
  std::string text;
  for (const YAML::Node& item : node) {
    if (text.size() > kMaxShown) break;
    text += text.empty() ? "" : ", ";
    text += item.IsScalar() ? item.Scalar() : item.IsNull() ? "null" : "...";
  }
  return "[" + shortened(text) + "]";
}

std::optional<double> toNumber(const YAML::Node& node) {
  if (!node.IsScalar() || isQuoted(node)) return {};
  return parseNumber(node.Scalar());
}

std::optional<int> toInteger(const YAML::Node& node) {
  const std::optional<double> value = toNumber(node);
  if (!value || node.Scalar().find_first_of(".eE") != std::string::npos) return {};
  if (std::abs(*value) > std::numeric_limits<int>::max()) return {};
  return static_cast<int>(*value);
}

std::optional<bool> toFlag(const YAML::Node& node) {
  if (!node.IsScalar() || isQuoted(node)) return {};
  if (node.Scalar() == "true") return true;
  if (node.Scalar() == "false") return false;
  return {};
}

}  // namespace palpate::keys
