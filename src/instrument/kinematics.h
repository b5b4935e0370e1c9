// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <urdf_model/model.h>

#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/instrument/instrument.h"
#include "urdf_outline.h"

namespace palpate::instrument {

/// A link and its parent joint P -> L, as in KDL. At the joint position q [m or rad],
///
///   X_PL = (rotation by q about `axis` at `origin`) X_end      revolute
///   X_PL = (shift by origin + q axis) X_end                    prismatic
///   X_PL = X_end                                               fixed
struct Segment {
  enum class Kind { kFixed, kRevolute, kPrismatic };

  int parent = -1;  ///< Parent link; -1 for the root.
  Kind kind = Kind::kFixed;
  int joint = -1;              ///< Driven joint, or -1 if fixed.
  double multiplier = 1.0;     ///< q = multiplier * (driven joint's position) + offset.
  double offset = 0.0;         ///< [m or rad]
  Vec3 axis = Vec3::Zero();    ///< Unit, in P.
  Vec3 origin = Vec3::Zero();  ///< [m], in P.
  Pose X_end = Pose::Identity();
};

/// Links in depth-first order, parents first; segment i belongs to link i. Joint maths are KDL's;
/// its tree is not used, since its joints cache their last pose and are not thread-safe.
struct Kinematics {
  std::vector<std::string> links;
  std::vector<Joint> joints;
  std::vector<Segment> segments;
};

/// @pre `outline` is of the same file, without problems.
Kinematics buildKinematics(const urdf::ModelInterface& model, const UrdfOutline& outline);

/// X_PL for positions `q` of the driven joints.
Pose segmentPose(const Segment& segment, const Eigen::VectorXd& q);

}  // namespace palpate::instrument
