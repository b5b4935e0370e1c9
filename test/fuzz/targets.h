// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::fuzz {

/// What must not become of a file's bytes. Every exception but InputError is one as well.
class Fault : public std::logic_error {
  using std::logic_error::logic_error;
};

/// One kind of file, and what a program does with its bytes.
struct Target {
  /// Also of its folders: seeds/<name>, files that are well, and regressions/<name>, files with
  /// which something was wrong once.
  const char* name;
  /// Reads them by the code that a user runs, and looks at what was read. Throws InputError where
  /// they are refused, Fault where what was read cannot be right.
  void (*read)(std::string_view bytes);
  /// Files that are well, where they are made by the program's own writers and not kept; or null.
  std::vector<std::string> (*seeds)() = nullptr;
  /// Limits of the memory of reading: bytes per byte of the file, plus a constant [bytes].
  double memory_each = 256.0;
  std::size_t memory_more = std::size_t{1} << 20;
};

/// All that this program was linked with: those of the core, or those that need ROS.
const std::vector<Target>& targets();
/// @throws std::invalid_argument if there is none of that name; it lists them.
const Target& targetNamed(const std::string& name);

enum class Outcome { kRead, kRefused };

/// Gives the bytes to the target. What was refused is said in a message that names the file and is
/// short, and no more memory was taken than the target may.
/// @throws Fault, or what the target lets through.
Outcome tryBytes(const Target& target, std::string_view bytes);

/// @throws Fault saying `what` if it does not hold.
inline void require(bool holds, const char* what) {
  if (!holds) throw Fault(what);
}

}  // namespace palpate::fuzz
