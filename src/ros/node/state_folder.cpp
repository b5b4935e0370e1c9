// SPDX-License-Identifier: GPL-3.0-or-later
#include "state_folder.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/io/state_file.h"

namespace palpate::node {
namespace {

namespace fs = std::filesystem;

constexpr long kMostStates = 1000;
constexpr char kEnding[] = ".state";

/// "state-20240229T123456.789012Z.state"; a name that sorts by time.
std::string nameByTime() {
  const auto now = std::chrono::system_clock::now();
  const std::time_t t = std::chrono::system_clock::to_time_t(now);
  const auto us =
      std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch()).count();
  std::tm utc{};
  gmtime_r(&t, &utc);
  char date[32], name[64];
  std::strftime(date, sizeof(date), "%Y%m%dT%H%M%S", &utc);
  std::snprintf(name, sizeof(name), "state-%s.%06dZ%s", date, static_cast<int>(us % 1000000),
                kEnding);
  return name;
}

/// "/left/palpate" is "last-left-palpate.state".
std::string nameOfLast(const std::string& node) {
  std::string name = "last" + node;
  std::replace(name.begin(), name.end(), '/', '-');
  return name + kEnding;
}

}  // namespace

StateFolder::StateFolder(std::string folder, const std::string& node)
    : folder_(std::move(folder)), last_(nameOfLast(node)) {}

std::string StateFolder::add(const sim::SimulatorState& state) const {
  fs::create_directories(folder_);
  const long states = std::count_if(
      fs::directory_iterator(folder_), fs::directory_iterator(),
      [](const fs::directory_entry& entry) { return entry.path().extension() == kEnding; });
  if (states >= kMostStates) {
    throw InputError(folder_, "", std::to_string(states) + " states",
                     "are as many as are kept: remove some");
  }
  return write(nameByTime(), state);
}

std::string StateFolder::keepLast(const sim::SimulatorState& state) const {
  return write(last_, state);
}

std::string StateFolder::write(const std::string& name, const sim::SimulatorState& state) const {
  fs::create_directories(folder_);
  const fs::path file = fs::path(folder_) / name;
  // A link under the name of a file that is written again would lead out of the folder.
  if (fs::is_symlink(fs::symlink_status(file))) fs::remove(file);
  io::writeState(file.string(), state);
  return file.string();
}

}  // namespace palpate::node
