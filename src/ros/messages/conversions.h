// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <ros/time.h>

#include <string>

#include "node_state.h"
#include "palpate/ContactModel.h"
#include "palpate/StepReport.h"
#include "palpate/base/types.h"
#include "palpate/haptics/local_model.h"
#include "palpate/sim/step_report.h"

namespace palpate::node {

// Between the core's types and messages. No message made here holds a number that is not finite.

geometry_msgs::Point toPoint(const Vec3& p);

/// A wrench with a component that is not finite becomes zero.
geometry_msgs::WrenchStamped toMsg(const Wrench& wrench, const ros::Time& stamp,
                                   const std::string& frame);

/// A model with a number that is not finite becomes none: no wrench, no stiffness.
palpate::ContactModel toMsg(const haptics::ContactModel& model, const ros::Time& stamp);

Wrench fromMsg(const geometry_msgs::Wrench& wrench);

/// `cycle_ms`: wall time of the cycle [ms]. A number that is not finite becomes -1.
palpate::StepReport toMsg(const sim::StepReport& report, NodeState state, const ros::Time& stamp,
                          double cycle_ms);

geometry_msgs::TransformStamped toMsg(const Pose& X_AB, const std::string& frame_A,
                                      const std::string& frame_B, const ros::Time& stamp);

Pose toPose(const geometry_msgs::Transform& transform);

}  // namespace palpate::node
