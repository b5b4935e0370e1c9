// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/torture/torture_run.h"

namespace palpate::torture {

/// A scene that fails a criterion, made plainer while it still fails it: fewer rows, tools and
/// organs, no friction, weight, memory or other step in time, a law and an element as they are by
/// default, over and over until none of these can go. Runs in `folder`, at most for so many
/// seconds, in which it leaves nothing to rely on.
TortureScene shrunk(const TortureScene& scene, const Failure& failure, const std::string& folder,
                    const RunLimits& limits, double seconds);

}  // namespace palpate::torture
