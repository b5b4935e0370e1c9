// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

namespace palpate::keys {

/// The single document of a YAML file, a map. @throws InputError for any other file.
YAML::Node readYamlMap(const std::string& file);

/// Node at "key" or "key[1].name" below a map; empty if absent.
std::optional<YAML::Node> findPath(const YAML::Node& map, const std::string& path);

/// " [line 12]"; "" if unknown.
std::string lineOf(const YAML::Node& node);

/// Text of the node, shortened for a message: "0.5", "[0, 0, x]", "{...}".
std::string shown(const YAML::Node& node);

/// Number of an unquoted scalar; empty for .nan and .inf.
std::optional<double> toNumber(const YAML::Node& node);

/// Integer of an unquoted scalar.
std::optional<int> toInteger(const YAML::Node& node);

/// Value true or false; empty otherwise.
std::optional<bool> toFlag(const YAML::Node& node);

}  // namespace palpate::keys
