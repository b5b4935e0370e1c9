// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/time.h>

#include <string>
#include <vector>

#include "palpate/RunRecord.h"
#include "palpate/scene/scene.h"

namespace palpate::node {

/// Of this program and of `scene`, which was read from its file and has keys replaced by
/// parameters, perhaps. `initial_state`: the file of the state that it begins with; "": its rest.
palpate::RunRecord recordOf(const scene::Scene& scene, const std::string& initial_state,
                            const ros::Time& stamp);

/// How a run of `now` differs from that of `recorded`, a line each: another scene file, keys of
/// other values, files that are others or of other bytes. Not where they lie, and not what program
/// ran.
std::vector<std::string> differences(const palpate::RunRecord& recorded,
                                     const palpate::RunRecord& now);

/// "0.1.0, commit 0123456789ab": what ran.
std::string programOf(const palpate::RunRecord& record);

}  // namespace palpate::node
