// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/contact/rigid_contact.h"
#include "palpate/scene/scene_parts.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

/// What the tools feel of the anatomy. Remembers nothing.
class AnatomyContact {
 public:
  /// `parts` outlives this.
  explicit AnatomyContact(const scene::SceneParts& parts);

  /// Adds to the results of the instruments, whose control frames are placed, what the anatomy does
  /// to them where they are, and the contacts. An instrument without poses is not there.
  void press(const std::vector<LinkPoses>& poses, StepResult* result);

  /// Whether instrument i, with its links there, is clear of the anatomy.
  bool isFree(std::size_t i, const LinkPoses& links) const;

 private:
  struct Shape {
    std::size_t link;
    Pose X_LG;
    std::vector<contact::TouchBall> balls;
    double bounding_radius;
  };
  std::vector<std::vector<Shape>> shapes_;       // of each instrument
  std::vector<contact::RigidContact> contacts_;  // with each part of the anatomy
};

}  // namespace palpate::sim
