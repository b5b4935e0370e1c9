// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"

#include <CLI/CLI.hpp>
#include <utility>

namespace palpate::cli {

CommandOption& CommandOption::required() {
  option_->required();
  return *this;
}

CommandOption& CommandOption::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}

CommandOption& CommandOption::between(int low, int high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

CommandOption& CommandOption::oneOf(const std::vector<std::string>& names) {
  option_->check(CLI::IsMember(names));
  return *this;
}

Command::Command(CLI::App& app, const std::string& name, const std::string& help)
    : app_(app.add_subcommand(name, help)) {}

CommandOption Command::option(const std::string& name, std::string* value,
                              const std::string& help) {
  return CommandOption(app_->add_option(name, *value, help));
}

CommandOption Command::option(const std::string& name, double* value, const std::string& help) {
  return CommandOption(app_->add_option(name, *value, help));
}

CommandOption Command::option(const std::string& name, int* value, const std::string& help) {
  return CommandOption(app_->add_option(name, *value, help));
}

CommandOption Command::option(const std::string& name, std::optional<std::string>* value,
                              const std::string& help) {
  return CommandOption(app_->add_option(name, *value, help));
}

CommandOption Command::option(const std::string& name, std::optional<double>* value,
                              const std::string& help) {
  return CommandOption(app_->add_option(name, *value, help));
}

CommandOption Command::option(const std::string& name, std::optional<int>* value,
                              const std::string& help) {
  return CommandOption(app_->add_option(name, *value, help));
}

CommandOption Command::option(const std::string& name, std::vector<std::string>* values,
                              const std::string& help) {
  return CommandOption(app_->add_option(name, *values, help));
}

CommandOption Command::option(const std::string& name,
                              const std::function<void(const std::string&)>& take,
                              const std::string& help) {
  return CommandOption(app_->add_option_function<std::string>(name, take, help));
}

void Command::flag(const std::string& name, bool* value, const std::string& help) {
  app_->add_flag(name, *value, help);
}

void Command::onUse(std::function<void()> use) { app_->callback(std::move(use)); }

}  // namespace palpate::cli
