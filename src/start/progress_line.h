// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::start {

/// Progress on standard error: on a terminal one line that is written over, elsewhere a line a new
/// task.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { finish(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `fraction` in [0, 1].
  void show(const std::string& task, double fraction);
  /// Ends the line.
  void finish();

 private:
  bool terminal_;
  std::string task_;
  int percent_ = -1;
};

}  // namespace palpate::start
