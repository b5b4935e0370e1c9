// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::formats {

struct VrmlNode;

/// Value of a field. Numbers and truth values (0, 1) are numbers, strings are dropped.
struct VrmlField {
  std::vector<double> numbers;
  std::vector<std::shared_ptr<const VrmlNode>> nodes;
};

/// A node of the scene. USE shares nodes without cycles, since a name is defined only after its
/// node's closing brace.
struct VrmlNode {
  std::string type;   ///< "Transform", "Shape", ...
  std::string where;  ///< "line 12"
  int height = 0;     ///< Longest chain of nodes below, also by USE; bounded.
  std::map<std::string, VrmlField, std::less<>> fields;

  /// The field `name`; empty if absent.
  const VrmlField& field(std::string_view name) const;
  bool has(std::string_view name) const { return fields.count(name) > 0; }
};

/// Top-level nodes of a VRML 2.0 file. @throws InputError, also for PROTO and EXTERNPROTO.
std::vector<std::shared_ptr<const VrmlNode>> parseVrml(const std::string& file,
                                                       std::string_view bytes);

}  // namespace palpate::formats
