// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/torture/criteria.h"

namespace palpate::torture {

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
