// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tissue/organ/organ_bodies.h"

namespace palpate::tissue {

/// An organ with its name.
struct NamedOrgan {
  std::string name;
  std::unique_ptr<OrganBodies> tissue;
};

/// Makes one model of several organs. In each cycle, BodyGroups solves interacting bodies as one;
/// other bodies have bitwise the results of a scene of their own. Results except sums over organs
/// do not depend on the order of `organs`. Bodies without StepMethod::motion() do not interact, as
/// a note says.
std::unique_ptr<TissueModel> makeFemOrgans(std::vector<NamedOrgan> organs,
                                           const ModelSettings& settings);

}  // namespace palpate::tissue
