// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/torture/criteria.h"

namespace palpate::torture {

// Rounding error of a sum over the sum of norms.
inline constexpr double kRoundingOfForces = 1e-9;
// Factor by which a reported residual may be too small.
inline constexpr double kTwice = 2.0;
// Tolerated friction beyond Coulomb's law, over contact forces; no further solve corrects it.
inline constexpr double kOfFriction = 1e-4;

// Each criterion has its own file.
std::unique_ptr<Criterion> checkFinite();
std::unique_ptr<Criterion> checkBounded(const TortureScene& scene);
std::unique_ptr<Criterion> checkInverted(const TortureScene& scene);
std::unique_ptr<Criterion> checkTruth(const TortureScene& scene, const sim::Simulator& simulator);
std::unique_ptr<Criterion> checkWrench(const TortureScene& scene, const sim::Simulator& simulator);
std::unique_ptr<Criterion> checkEnergy(const TortureScene& scene, const sim::Simulator& simulator);
std::unique_ptr<Criterion> checkRest(const TortureScene& scene, const sim::Simulator& simulator);
std::unique_ptr<Criterion> checkTime(const TortureScene& scene);

/// Text for messages: "residual 3e-05 N".
std::string said(const char* what, double value, const char* unit);

}  // namespace palpate::torture
