// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_line.h"

#include <unistd.h>

#include <cstdio>

namespace palpate::start {

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const std::string& task, double fraction) {
  const int percent = static_cast<int>(100.0 * fraction);
  if (task == task_ && (percent == percent_ || !terminal_)) return;
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K%s %3d %%", task.c_str(), percent);
  } else {
    std::fprintf(stderr, "%s ...\n", task.c_str());
  }
  std::fflush(stderr);
  task_ = task;
  percent_ = percent;
}

void ProgressLine::finish() {
  if (terminal_ && !task_.empty()) std::fputs("\r\033[K", stderr);
  task_.clear();
  percent_ = -1;
}

}  // namespace palpate::start
