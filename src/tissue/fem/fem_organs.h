// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "organ_bodies.h"

namespace palpate::tissue {

/// Several organs, by name.
struct NamedOrgan {
  std::string name;
  std::unique_ptr<OrganBodies> tissue;
};

/// Organs as one model: in each cycle bodies between which an interaction of `settings` may act are
/// solved together, see BodyGroups, and the others as if they were alone in the scene, to the bit.
/// Results but sums over organs do not depend on the order of `organs`. Bodies whose method has no
/// motion to lend (StepMethod::motion()) act on no others, and a note says so.
std::unique_ptr<TissueModel> makeFemOrgans(std::vector<NamedOrgan> organs,
                                           const ModelSettings& settings);

}  // namespace palpate::tissue
