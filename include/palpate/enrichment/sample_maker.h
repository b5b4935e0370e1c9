// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/enrichment/database_folder.h"
#include "palpate/enrichment/press_plan.h"
#include "palpate/enrichment/pressed_body.h"

namespace palpate::enrichment {

/// A body for repeated presses.
struct PressedSurfaces {
  mesh::SurfaceMesh coarse, fine;  ///< At rest [m].
  std::vector<int> contacts;       ///< Coarse points to press.
  PressPlan plan;
  std::string made_by;  ///< Everything that determines a sample, apart from the surfaces.
  std::function<std::unique_ptr<PressedBody>()> make_body;  ///< Makes a body for one thread.
};

/// Samples `part`, `part + of`, `part + 2 of` and so on.
struct SharePart {
  int part = 0, of = 1;
};

/// Makes the missing samples of a database in a folder.
class SampleMaker {
 public:
  /// @throws InputError as DatabaseFolder.
  SampleMaker(const std::string& folder, PressedSurfaces surfaces, int samples,
              SharePart share = {});

  /// `progress`: the present task and a fraction in [0, 1]; may be empty. @throws exceptions of
  /// make_body() and of writing.
  void run(int threads, const std::function<void(const std::string&, double)>& progress);

  int wanted() const { return wanted_; }  ///< Number of samples of this share.
  int made() const { return static_cast<int>(left_.size()); }
  int unsolved() const { return unsolved_; }  ///< Number of failed samples of run().

 private:
  PressedSurfaces surfaces_;
  DatabaseFolder folder_;
  std::vector<int> left_;
  int wanted_ = 0, unsolved_ = 0;
};

}  // namespace palpate::enrichment
