// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <string_view>

#include "palpate/RunRecord.h"

namespace palpate::node {

// Whether the bytes are a message of the type, whole: strings and lists end within them. roscpp
// makes a list as long as it is told before it looks whether so much follows, which is up to 128
// GB.
bool areMessage(std::string_view bytes, const sensor_msgs::JointState*);
bool areMessage(std::string_view bytes, const tf2_msgs::TFMessage*);
bool areMessage(std::string_view bytes, const palpate::RunRecord*);

}  // namespace palpate::node
