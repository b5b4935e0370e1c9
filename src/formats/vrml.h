// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::formats {

struct VrmlNode;

/// What stands behind a field's name. VRML's own types are not told apart: numbers and truth
/// values (0, 1) are numbers, strings are dropped.
struct VrmlField {
  std::vector<double> numbers;
  std::vector<std::shared_ptr<const VrmlNode>> nodes;
};

/// One node of the scene. USE shares nodes, never in a circle: a name is known only after its
/// node's closing brace.
struct VrmlNode {
  std::string type;   ///< "Transform", "Shape", ...
  std::string where;  ///< "line 12"
  int height = 0;     ///< Longest chain of nodes below, those by USE included; bounded.
  std::map<std::string, VrmlField, std::less<>> fields;

  /// The field of this name; an empty one where it is absent.
  const VrmlField& field(std::string_view name) const;
  bool has(std::string_view name) const { return fields.count(name) > 0; }
};

/// The nodes on the top of a VRML 2.0 file. @throws InputError; PROTO and EXTERNPROTO are refused.
std::vector<std::shared_ptr<const VrmlNode>> parseVrml(const std::string& file,
                                                       std::string_view bytes);

}  // namespace palpate::formats
