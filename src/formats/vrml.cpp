// SPDX-License-Identifier: GPL-3.0-or-later
#include "vrml.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cursor.h"
#include "palpate/base/number.h"

namespace palpate::formats {
namespace {

using NodePointer = std::shared_ptr<const VrmlNode>;

constexpr int kDeepest = 200;  // nesting of nodes

class Parser {
 public:
  explicit Parser(Cursor& in) : in_(in) {}

  std::vector<NodePointer> scene() {
    std::vector<NodePointer> nodes;
    while (!in_.atEnd()) {
      const std::string_view word = in_.word();
      if (!isStatement(word)) nodes.push_back(node(word, 0));
    }
    return nodes;
  }

 private:
  /// Skips "ROUTE a.b TO c.d": animation does not move the mesh.
  bool isStatement(std::string_view word) {
    if (word == "PROTO" || word == "EXTERNPROTO") {
      in_.fail(word, "prototypes are not read; write plain nodes");
    }
    if (word != "ROUTE") return false;
    in_.word();
    in_.expect("TO");
    in_.word();
    return true;
  }

  /// `word`, already read, is DEF, USE or the node's type.
  NodePointer node(std::string_view word, int depth) {
    if (depth > kDeepest) in_.fail(word, "the nodes are nested too deep");
    if (word == "USE") {
      const std::string name(in_.word());
      const auto found = named_.find(name);
      if (found == named_.end()) in_.fail(name, "USE must name a node that DEF named before");
      return found->second;
    }
    std::string name;
    if (word == "DEF") {
      name = in_.word();
      word = in_.word();
    }
    auto made = std::make_shared<VrmlNode>();
    made->type = word;
    made->where = in_.where();
    in_.expect("{");
    for (;;) {
      const std::string_view key = in_.word();
      if (key == "}") break;
      if (key.empty()) in_.fail("", "truncated: '}' must follow");
      if (isStatement(key)) continue;
      made->fields[std::string(key)] = field(depth);
    }
    for (const auto& [key, field] : made->fields) {
      for (const NodePointer& child : field.nodes) {
        made->height = std::max(made->height, child->height + 1);
      }
    }
    if (made->height > kDeepest) in_.fail(name, "the nodes are nested too deep");
    if (!name.empty()) named_[name] = made;
    return made;
  }

  VrmlField field(int depth) {
    VrmlField made;
    const std::string_view first = in_.word();
    if (first != "[") {
      addValue(first, depth, &made);
      // A vector without brackets extends as long as numbers follow.
      while (!made.numbers.empty()) {
        const std::optional<double> number = parseNumber(in_.peek());
        if (!number) break;
        in_.word();
        made.numbers.push_back(*number);
      }
      return made;
    }
    for (;;) {
      const std::string_view word = in_.word();
      if (word == "]") return made;
      addValue(word, depth, &made);
    }
  }

  void addValue(std::string_view word, int depth, VrmlField* field) {
    if (word.empty()) in_.fail("", "truncated: a value must follow");
    const std::optional<double> number = parseAnyNumber(word);
    if (number && std::isfinite(*number)) {
      field->numbers.push_back(*number);
    } else if (number) {
      in_.fail(word, "must be finite");
    } else if (word == "TRUE" || word == "FALSE") {
      field->numbers.push_back(word == "TRUE" ? 1.0 : 0.0);
    } else if (word != "NULL" && word.front() != '"') {
      const std::string_view next = in_.peek();
      if (word != "DEF" && word != "USE" && next != "{") {
        in_.fail(word, "must be a number, a string or a node");
      }
      field->nodes.push_back(node(word, depth + 1));
    }
  }

  Cursor& in_;
  std::map<std::string, NodePointer> named_;
};

}  // namespace

const VrmlField& VrmlNode::field(std::string_view name) const {
  static const VrmlField kNone;
  const auto found = fields.find(name);
  return found == fields.end() ? kNone : found->second;
}

std::vector<NodePointer> parseVrml(const std::string& file, std::string_view bytes) {
  constexpr std::string_view kHeader = "#VRML V2.0 utf8";
  Syntax syntax;
  syntax.comment = '#';
  syntax.comma_is_blank = true;
  syntax.punctuation = "{}[]";
  syntax.strings = true;
  Cursor in(file, bytes, syntax);
  const std::string_view header = in.restOfLine();
  if (header.substr(0, kHeader.size()) != kHeader) {
    in.fail(header, "must begin with '" + std::string(kHeader) + "' (VRML 1 is not read)");
  }
  return Parser(in).scene();
}

}  // namespace palpate::formats
