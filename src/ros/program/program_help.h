// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "param_help.h"

namespace palpate::node {

/// What `--help` says of a program.
struct About {
  struct Row {
    std::string name, type, what;
  };
  std::string program;      ///< Of the executable.
  std::string what;         ///< What it does, in sentences.
  ParamHelp params;         ///< Its private parameters.
  std::vector<Row> hears;   ///< Topics that it subscribes to.
  std::vector<Row> says;    ///< Topics that it publishes.
  std::vector<Row> serves;  ///< Services that it offers.
};

/// The part of `--help` below the options: parameters, topics, services.
std::string graphHelp(const About& about);

/// Reads what is left of the arguments without remappings and parameters of ROS: `--help`, or
/// nothing. The exit status if the program ends there, after it was said why; asks no master.
std::optional<int> answerOptions(int argc, char** argv, const About& about);

}  // namespace palpate::node
