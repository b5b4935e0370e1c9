// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/torture/torture_run.h"

namespace palpate::torture {

/// Simplifies a scene while it still fails a criterion: fewer rows, tools and organs, no friction,
/// gravity or viscosity, default integrator, law and element, until nothing more can be removed.
/// Runs in `folder` for at most `seconds` [s]; files left there have no meaning.
TortureScene shrunk(const TortureScene& scene, const Failure& failure, const std::string& folder,
                    const RunLimits& limits, double seconds);

}  // namespace palpate::torture
