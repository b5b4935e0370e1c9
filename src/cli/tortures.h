// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "palpate/torture/result_table.h"
#include "palpate/torture/torture_run.h"

namespace palpate::cli {

/// What `palpate torture` is called with.
struct TortureOptions {
  int count = 100, seed = 1, first = 0;
  std::optional<int> only;
  std::string out = "torture", part = "1/1", category, model, method, report, table, commit = "-";
  double minutes = 0.0, scene_limit = 60.0, cycle_limit = 60.0, shrink = 30.0;
  int tetrahedra = 0;
  bool keep = false, again = false;
};

/// Every `of`-th scene, from the `number`-th.
struct Part {
  int number = 1, of = 1;
  std::string name() const { return std::to_string(number) + "_of_" + std::to_string(of); }
};

/// @throws InputError
Part readPart(const std::string& text);

/// Random scenes, each run in a folder of its own, which stays where it failed, and its line in the
/// table of this part.
class Tortures {
 public:
  /// Keeps `options`, which must outlive it.
  Tortures(const TortureOptions& options, const Part& part);

  /// A scene in which the program ended the last time has failed.
  void noteCrash();

  torture::ResultLine runOne(const torture::TortureScene& scene);
  torture::TortureScene drawn(int number) const;

  /// What replays it.
  std::string commandOf(const torture::TortureScene& scene) const;

 private:
  bool hasOtherBitsByTwoThreads(const torture::TortureScene& scene, const std::string& folder,
                                const torture::Outcome& outcome) const;
  void runCut(const torture::TortureScene& scene, const std::string& folder,
              torture::Outcome* outcome) const;

  const TortureOptions& options_;
  std::filesystem::path folder_;
  std::string table_, running_;
  torture::RunLimits limits_;
};

}  // namespace palpate::cli
