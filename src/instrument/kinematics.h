// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <urdf_model/model.h>

#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/instrument/instrument.h"
#include "urdf_outline.h"

namespace palpate::instrument {

/// One link and the joint P -> L above it, as in KDL: at position q [m or rad] of the joint,
///
///   X_PL = (rotation by q about `axis` at `origin`) X_end      revolute
///   X_PL = (shift by origin + q axis) X_end                    prismatic
///   X_PL = X_end                                               fixed
struct Segment {
  enum class Kind { kFixed, kRevolute, kPrismatic };

  int parent = -1;  ///< Link; -1 for the root.
  Kind kind = Kind::kFixed;
  int joint = -1;              ///< Driven joint, or -1 if fixed.
  double multiplier = 1.0;     ///< q = multiplier * (driven joint's position) + offset.
  double offset = 0.0;         ///< [m or rad]
  Vec3 axis = Vec3::Zero();    ///< Unit, in P.
  Vec3 origin = Vec3::Zero();  ///< [m], in P.
  Pose X_end = Pose::Identity();
};

/// Links in depth-first order, so that a parent stands before its children. Segment i belongs to
/// link i. The maths of the joints is KDL's; its tree is not asked every cycle because its joints
/// cache their last pose, which threads must not share.
struct Kinematics {
  std::vector<std::string> links;
  std::vector<Joint> joints;
  std::vector<Segment> segments;
};

/// `outline` is of the same file and has no problems.
Kinematics buildKinematics(const urdf::ModelInterface& model, const UrdfOutline& outline);

/// X_PL at the positions `q` of the driven joints.
Pose segmentPose(const Segment& segment, const Eigen::VectorXd& q);

}  // namespace palpate::instrument
