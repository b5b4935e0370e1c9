// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/torture/criteria.h"

namespace palpate::torture {

// Of the forces that are summed: what sums of them are off by rounding.
inline constexpr double kRoundingOfForces = 1e-9;
// What is unbalanced may be told by so much too small.
inline constexpr double kTwice = 2.0;
// Of what presses: as much friction beyond Coulomb's law is taken back without another solution.
inline constexpr double kOfFriction = 1e-4;

// One file each.
std::unique_ptr<Criterion> checkFinite();
std::unique_ptr<Criterion> checkBounded(const TortureScene& scene);
std::unique_ptr<Criterion> checkInverted(const TortureScene& scene);
std::unique_ptr<Criterion> checkTruth(const TortureScene& scene, const sim::Simulator& simulator);
std::unique_ptr<Criterion> checkWrench(const TortureScene& scene, const sim::Simulator& simulator);
std::unique_ptr<Criterion> checkEnergy(const TortureScene& scene, const sim::Simulator& simulator);
std::unique_ptr<Criterion> checkRest(const TortureScene& scene, const sim::Simulator& simulator);
std::unique_ptr<Criterion> checkTime(const TortureScene& scene);

/// "residual 3e-05 N": numbers in messages.
std::string said(const char* what, double value, const char* unit);

}  // namespace palpate::torture
