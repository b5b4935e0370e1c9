// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

namespace palpate::keys {

/// The one document of a YAML file, a map.
/// @throws InputError if the file is anything else.
YAML::Node readYamlMap(const std::string& file);

/// What stands at "key" or "key[1].name" below a map, if anything.
std::optional<YAML::Node> findPath(const YAML::Node& map, const std::string& path);

/// " [line 12]", or "" if the node's place is not known.
std::string lineOf(const YAML::Node& node);

/// What stands there, shortened for a message: "0.5", "[0, 0, x]", "{...}".
std::string shown(const YAML::Node& node);

/// The number that an unquoted scalar is; .nan and .inf are no numbers here.
std::optional<double> toNumber(const YAML::Node& node);

/// The whole number that an unquoted scalar is.
std::optional<int> toInteger(const YAML::Node& node);

/// true or false.
std::optional<bool> toFlag(const YAML::Node& node);

}  // namespace palpate::keys
