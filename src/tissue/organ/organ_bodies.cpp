// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_bodies.h"

#include "fem_organ.h"

namespace palpate::tissue {

const TissueStep& OrganBodies::step(const std::vector<contact::Obstacle>& obstacles, double dt) {
  beginCycle(obstacles, dt);
  stepped_.clear();
  addBodies(&stepped_);
  for (FemOrgan* body : stepped_) {
    body->begin(obstacles, dt);
    body->stepAlone(dt);
  }
  return endCycle(obstacles, dt);
}

}  // namespace palpate::tissue
