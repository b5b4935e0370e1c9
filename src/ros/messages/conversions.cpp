// SPDX-License-Identifier: GPL-3.0-or-later
#include "conversions.h"

#include <cmath>

#include "topics.h"

namespace palpate::node {
namespace {

double finite(double value) { return std::isfinite(value) ? value : -1.0; }

template <class Message>
Message fromVector(const Vec3& v) {
  Message m;
  m.x = v.x();
  m.y = v.y();
  m.z = v.z();
  return m;
}

}  // namespace

geometry_msgs::Point toPoint(const Vec3& p) { return fromVector<geometry_msgs::Point>(p); }

geometry_msgs::WrenchStamped toMsg(const Wrench& wrench, const ros::Time& stamp,
                                   const std::string& frame) {
  geometry_msgs::WrenchStamped m;
  m.header.stamp = stamp;
  m.header.frame_id = frame;
  if (wrench.allFinite()) {
    m.wrench.force = fromVector<geometry_msgs::Vector3>(wrench.force);
    m.wrench.torque = fromVector<geometry_msgs::Vector3>(wrench.torque);
  }
  return m;
}

palpate::ContactModel toMsg(const haptics::ContactModel& model, const ros::Time& stamp) {
  palpate::ContactModel message;
  message.header.stamp = stamp;
  message.header.frame_id = kWorldFrame;
  message.position = toPoint(model.p_W);
  message.wrench = toMsg(model.wrench, stamp, kWorldFrame).wrench;
  message.reach = model.reach;
  if (!model.wrench.allFinite() || !model.stiffness_W.allFinite()) return message;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message.stiffness[static_cast<std::size_t>(3 * row + column)] =
          model.stiffness_W(row, column);
    }
  }
  return message;
}

Wrench fromMsg(const geometry_msgs::Wrench& wrench) {
  return {Vec3(wrench.force.x, wrench.force.y, wrench.force.z),
          Vec3(wrench.torque.x, wrench.torque.y, wrench.torque.z)};
}

palpate::StepReport toMsg(const sim::StepReport& report, NodeState state, const ros::Time& stamp,
                          double cycle_ms) {
  palpate::StepReport m;
  m.header.stamp = stamp;
  m.header.frame_id = kWorldFrame;
  m.time = finite(report.time);
  m.step = finite(report.step);
  m.state = toString(state);
  m.status = std::string(solver::toString(report.status));
  m.contacts = report.contacts;
  m.max_penetration = finite(report.max_penetration);
  m.sweep_stages = report.sweep_stages;
  m.time_steps = report.time_steps;
  m.recovery = report.recovery;
  m.newton_iterations = report.newton_iterations;
  m.cg_iterations = report.linear_iterations;
  m.walk_steps = report.walk_steps;
  m.tree_queries = report.tree_queries;
  m.residual = finite(report.residual);
  m.tolerance = finite(report.tolerance);
  m.imbalance = finite(report.imbalance);
  m.min_jacobian = finite(report.min_jacobian);
  m.kinetic_energy = finite(report.kinetic_energy);
  m.elastic_energy = finite(report.elastic_energy);
  m.mesh_error = finite(report.mesh_error);
  m.finest_edge = finite(report.finest_edge);
  m.cavity_pressure = finite(report.cavity_pressure);
  m.tools_inside = report.tools_inside;
  m.state_hash = report.state_hash;
  m.skipped_far_bodies = static_cast<int>(report.skipped.far_bodies);
  m.skipped_sleeping_organs = static_cast<int>(report.skipped.sleeping_organs);
  m.skipped_sleeping_islands = static_cast<int>(report.skipped.sleeping_islands);
  m.skipped_satisfied_solves = static_cast<int>(report.skipped.satisfied_solves);
  m.skipped_distant_samples = static_cast<int>(report.skipped.distant_samples);
  m.skipped_inactive_samples = static_cast<int>(report.skipped.inactive_samples);
  m.skipped_frictionless_touches = static_cast<int>(report.skipped.frictionless_touches);
  m.skipped_inviscid_solids = static_cast<int>(report.skipped.inviscid_solids);
  m.skipped_kept_stiffnesses = static_cast<int>(report.skipped.kept_stiffnesses);
  m.skipped_still_points = static_cast<int>(report.skipped.still_points);
  m.skipped_apart_organs = static_cast<int>(report.skipped.apart_organs);
  m.cycle_ms = finite(cycle_ms);
  m.contact_ms = 1e3 * report.phases[Phase::kContact];
  m.forces_ms = 1e3 * report.phases[Phase::kForces];
  m.assembly_ms = 1e3 * report.phases[Phase::kAssembly];
  m.linear_solve_ms = 1e3 * report.phases[Phase::kLinearSolve];
  m.line_search_ms = 1e3 * report.phases[Phase::kLineSearch];
  m.other_ms = 1e3 * report.phases[Phase::kOther];
  m.haptics_ms = 1e3 * report.phases[Phase::kHaptics];
  m.publish_ms = 1e3 * report.phases[Phase::kPublish];
  return m;
}

geometry_msgs::TransformStamped toMsg(const Pose& X_AB, const std::string& frame_A,
                                      const std::string& frame_B, const ros::Time& stamp) {
  geometry_msgs::TransformStamped m;
  m.header.stamp = stamp;
  m.header.frame_id = frame_A;
  m.child_frame_id = frame_B;
  m.transform.translation = fromVector<geometry_msgs::Vector3>(X_AB.translation());
  const Eigen::Quaterniond q = Eigen::Quaterniond(X_AB.linear()).normalized();
  m.transform.rotation.w = q.w();
  m.transform.rotation.x = q.x();
  m.transform.rotation.y = q.y();
  m.transform.rotation.z = q.z();
  return m;
}

Pose toPose(const geometry_msgs::Transform& transform) {
  const auto& t = transform.translation;
  const auto& r = transform.rotation;
  Pose X = Pose::Identity();
  X.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  X.translation() = Vec3(t.x, t.y, t.z);
  return X;
}

}  // namespace palpate::node
