// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
class Option;
}  // namespace CLI

namespace palpate::cli {

/// Something that a command takes, and what is allowed for it.
class CommandOption {
 public:
  explicit CommandOption(CLI::Option* option) : option_(option) {}

  CommandOption& required();
  CommandOption& positive();
  CommandOption& between(int low, int high);  ///< Both are allowed.
  CommandOption& oneOf(const std::vector<std::string>& names);

 private:
  CLI::Option* option_;
};

/// A subcommand of `app` with what it takes: CLI11 without its headers, which take longer to
/// compile than any command. A name with "--" is an option, one without an argument in its place.
/// Values must live until the command line is parsed, and what is not given stays as it is.
class Command {
 public:
  Command(CLI::App& app, const std::string& name, const std::string& help);

  CommandOption option(const std::string& name, std::string* value, const std::string& help);
  CommandOption option(const std::string& name, double* value, const std::string& help);
  CommandOption option(const std::string& name, int* value, const std::string& help);
  CommandOption option(const std::string& name, std::optional<std::string>* value,
                       const std::string& help);
  CommandOption option(const std::string& name, std::optional<double>* value,
                       const std::string& help);
  CommandOption option(const std::string& name, std::optional<int>* value, const std::string& help);
  /// May be given several times.
  CommandOption option(const std::string& name, std::vector<std::string>* values,
                       const std::string& help);
  CommandOption option(const std::string& name, const std::function<void(const std::string&)>& take,
                       const std::string& help);
  void flag(const std::string& name, bool* value, const std::string& help);

  /// Called when the user gives this command and all that it takes is right.
  void onUse(std::function<void()> use);

 private:
  CLI::App* app_;
};

}  // namespace palpate::cli
