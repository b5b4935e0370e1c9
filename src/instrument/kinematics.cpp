// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinematics.h"

#include <cmath>
#include <kdl/frames.hpp>
#include <kdl/joint.hpp>
#include <kdl/segment.hpp>
#include <kdl/tree.hpp>
#include <kdl_parser/kdl_parser.hpp>
#include <limits>
#include <map>
#include <stdexcept>

namespace palpate::instrument {
namespace {

constexpr double kMostFollowed = 1e9;  // limit of the product of chained mimic multipliers

Vec3 toVec3(const KDL::Vector& v) { return {v.x(), v.y(), v.z()}; }

Mat3 toMat3(const KDL::Rotation& R) {
  Mat3 M;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) M(i, j) = R(i, j);
  }
  return M;
}

Pose poseOf(const KDL::Frame& frame) {
  Pose X = Pose::Identity();
  X.linear() = toMat3(frame.M);
  X.translation() = toVec3(frame.p);
  return X;
}

Segment toSegment(const KDL::Segment& kdl, int parent) {
  Segment segment;
  segment.parent = parent;
  const KDL::Joint& joint = kdl.getJoint();
  segment.X_end = poseOf(joint.pose(0.0).Inverse() * kdl.getFrameToTip());
  if (joint.getType() == KDL::Joint::RotAxis || joint.getType() == KDL::Joint::TransAxis) {
    segment.kind = joint.getType() == KDL::Joint::RotAxis ? Segment::Kind::kRevolute
                                                          : Segment::Kind::kPrismatic;
    segment.axis = toVec3(joint.JointAxis());
    segment.origin = toVec3(joint.JointOrigin());
  }
  return segment;
}

Joint toJoint(const urdf::Joint& urdf) {
  Joint joint{urdf.name, urdf.type == urdf::Joint::PRISMATIC,
              -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (urdf.type != urdf::Joint::CONTINUOUS && urdf.limits) {
    joint.lower = urdf.limits->lower;
    joint.upper = urdf.limits->upper;
  }
  return joint;
}

/// Traverses the tree; joints of a link are in the order of the file.
class Builder {
 public:
  Builder(const urdf::ModelInterface& model, const UrdfOutline& outline)
      : model_(model), outline_(outline) {
    if (!kdl_parser::treeFromUrdfModel(model, tree_)) {
      throw std::invalid_argument("the links form no kinematic tree");
    }
  }

  Kinematics build() {
    addLink(model_.getRoot()->name, Segment());
    for (std::size_t i = 0; i < result_.segments.size(); ++i) {
      if (result_.segments[i].kind != Segment::Kind::kFixed) drive(above_[i], &result_.segments[i]);
    }
    return std::move(result_);
  }

 private:
  void addLink(const std::string& link, const Segment& segment,
               const urdf::Joint* joint = nullptr) {
    const int index = static_cast<int>(result_.links.size());
    result_.links.push_back(link);
    result_.segments.push_back(segment);
    above_.push_back(joint);
    if (segment.kind != Segment::Kind::kFixed && !joint->mimic) {
      driven_[joint->name] = static_cast<int>(result_.joints.size());
      result_.joints.push_back(toJoint(*joint));
    }
    for (const JointOutline& child : outline_.joints) {
      if (child.parent != link) continue;
      const auto& element = tree_.getSegment(child.child)->second;
      addLink(child.child, toSegment(GetTreeElementSegment(element), index),
              model_.getJoint(child.name).get());
    }
  }

  /// Follows the chain of mimics to the driven joint.
  void drive(const urdf::Joint* joint, Segment* segment) const {
    for (; joint->mimic; joint = model_.getJoint(joint->mimic->joint_name).get()) {
      segment->offset += segment->multiplier * joint->mimic->offset;
      segment->multiplier *= joint->mimic->multiplier;
    }
    if (!(std::abs(segment->multiplier) <= kMostFollowed) ||
        !(std::abs(segment->offset) <= kMostFollowed)) {
      throw std::invalid_argument(
          "a joint that follows '" + joint->name +
          "' by others goes too far: multipliers and offsets must give less "
          "than 1e9 together");
    }
    segment->joint = driven_.at(joint->name);
  }

  const urdf::ModelInterface& model_;
  const UrdfOutline& outline_;
  KDL::Tree tree_;
  Kinematics result_;
  std::vector<const urdf::Joint*> above_;
  std::map<std::string, int> driven_;
};

}  // namespace

Kinematics buildKinematics(const urdf::ModelInterface& model, const UrdfOutline& outline) {
  return Builder(model, outline).build();
}

Pose segmentPose(const Segment& segment, const Eigen::VectorXd& q) {
  if (segment.kind == Segment::Kind::kFixed) return segment.X_end;
  const double position = segment.multiplier * q[segment.joint] + segment.offset;
  Pose X = Pose::Identity();
  if (segment.kind == Segment::Kind::kRevolute) {
    const Vec3& a = segment.axis;
    X.linear() = toMat3(KDL::Rotation::Rot2(KDL::Vector(a.x(), a.y(), a.z()), position));
    X.translation() = segment.origin;
  } else {
    X.translation() = segment.origin + position * segment.axis;
  }
  return X * segment.X_end;
}

}  // namespace palpate::instrument
