// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::node {

/// Returns when the master answers that ros::init() will ask. Says on stderr, as `program`, which
/// URI is waited for, and when the master is there. Call before ros::init() and while signals have
/// their default actions, which end the program here. ROS itself would wait and heed none.
/// @throws InputError for a URI that is none.
void waitForMaster(int argc, char** argv, const char* program);

}  // namespace palpate::node
