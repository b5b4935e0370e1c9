// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Model "mass_spring": point masses at the corners of the organ's tetrahedra, springs along their
/// edges. An edge of length L with volume V around it has the stiffness E V / L^2, and the body
/// Young's modulus E where edges point everywhere alike; Poisson's ratio is then 1/4 [Wang 2005,
/// (7.59)]. Organs of this model touch one another as those of finite elements do, where they are
/// solved implicitly.
/// @throws as makeFem(); std::invalid_argument for what springs cannot be: a viscoelastic solid,
/// one with fibres, a mesh that adapts.
std::unique_ptr<TissueModel> makeMassSpring(const ModelDescription& description);

}  // namespace palpate::tissue
