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

/// A body that is to be pressed again and again.
struct PressedSurfaces {
  mesh::SurfaceMesh coarse, fine;  ///< At rest [m].
  std::vector<int> contacts;       ///< Coarse points that may be pressed.
  PressPlan plan;
  std::string made_by;  ///< All that decides a sample but the surfaces.
  std::function<std::unique_ptr<PressedBody>()> make_body;  ///< For each thread one.
};

/// Samples `part`, `part + of`, `part + 2 of` ... of all.
struct SharePart {
  int part = 0, of = 1;
};

/// Makes those samples of a database that its folder has not.
class SampleMaker {
 public:
  /// @throws InputError as DatabaseFolder.
  SampleMaker(const std::string& folder, PressedSurfaces surfaces, int samples,
              SharePart share = {});

  /// `progress`: what is done, and a part in [0, 1]; may be empty. @throws what make_body() and
  /// writing throw.
  void run(int threads, const std::function<void(const std::string&, double)>& progress);

  int wanted() const { return wanted_; }  ///< Of this share.
  int made() const { return static_cast<int>(left_.size()); }
  int unsolved() const { return unsolved_; }  ///< Of those that run() made.

 private:
  PressedSurfaces surfaces_;
  DatabaseFolder folder_;
  std::vector<int> left_;
  int wanted_ = 0, unsolved_ = 0;
};

}  // namespace palpate::enrichment
