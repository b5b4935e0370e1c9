// SPDX-License-Identifier: GPL-3.0-or-later
#include "view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "palpate/base/error.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/material/material.h"
#include "palpate/scene/tissue_file.h"

namespace palpate::node {
namespace {

constexpr double kAspect = 1.3;       // of a window with panels beside
constexpr double kShownWay = 0.45;    // of the box, from its middle to the tools
constexpr double kFilledShare = 0.8;  // of the window by the box
constexpr double kArrowLength = 0.4;  // of the box, at the typical force

struct SceneBox {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = -min;

  void add(const Points& points) {
    if (points.cols() == 0) return;
    min = min.cwiseMin(points.rowwise().minCoeff());
    max = max.cwiseMax(points.rowwise().maxCoeff());
  }
  bool empty() const { return !(min.array() <= max.array()).all(); }
  Vec3 middle() const { return 0.5 * (min + max); }
};

SceneBox sceneBox(const sim::Simulator& simulator) {
  SceneBox box;
  for (int i = 0; i < simulator.numOrgans(); ++i) box.add(simulator.positions(i));
  for (int i = 0; box.empty() && i < simulator.numAnatomy(); ++i) {
    box.add(simulator.anatomySurface(i).points);
  }
  return box;
}

/// Where the control frames are with all joints at zero, from the middle of the box; zero for tools
/// that come by tf, of which nobody knows where they rest.
Vec3 towardsTools(const sim::Simulator& simulator, const Vec3& middle) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    if (simulator.scene().instruments[static_cast<std::size_t>(i)].input != "joints") continue;
    const auto joints = static_cast<Eigen::Index>(simulator.instrument(i).joints().size());
    const sim::LinkPoses poses = simulator.linkPoses(i, Eigen::VectorXd::Zero(joints));
    const Vec3 way =
        poses[static_cast<std::size_t>(simulator.controlLink(i))].translation() - middle;
    if (way.norm() > 0.0) sum += way.normalized();
  }
  return sum;
}

/// The least distance of the camera from which all corners of a box are seen.
double distanceTo(const SceneBox& box, const Vec3& focus, double yaw, double pitch) {
  const Vec3 back(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw),
                  std::sin(pitch));
  const Vec3 right = Vec3::UnitZ().cross(back).normalized();
  const Vec3 up = back.cross(right);
  const double tall = kFilledShare * std::tan(0.5 * kFieldOfView), wide = kAspect * tall;
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = ((corner >> axis) & 1 ? box.max[axis] : box.min[axis]) - focus[axis];
    }
    const double across = std::max(std::abs(p.dot(right)) / wide, std::abs(p.dot(up)) / tall);
    distance = std::max(distance, p.dot(back) + across);
  }
  return distance;
}

/// Radius of the thinnest shape that an instrument touches with [m]: on the control frame's link,
/// or where that has none of all. 0: it has no shape.
double tipRadius(const sim::Simulator& simulator, int i) {
  double at_tip = 0.0, anywhere = 0.0;
  const auto lower = [](double radius, double* least) {
    if (*least == 0.0 || radius < *least) *least = radius;
  };
  for (const instrument::CollisionBody& body : simulator.instrument(i).bodies()) {
    const double radius = contact::inscribedRadius(body.geometry);
    lower(radius, &anywhere);
    if (body.link == simulator.controlLink(i)) lower(radius, &at_tip);
  }
  return at_tip > 0.0 ? at_tip : anywhere;
}

/// Of an organ's material at rest [Pa]; 0: the organ has none that its model could not do without.
double shearModulus(const scene::OrganConfig& organ, const std::string& scene_file) {
  try {
    const std::string key = "organ " + organ.name;
    return material::moduli(scene::makeSolid(organ.material, scene_file, key).law).mu;
  } catch (const InputError&) {
    return 0.0;
  }
}

/// Of a ball that is pressed in by its radius: into a half space [Hertz 1881], or into a sheet that
/// is held at its rim and stretches as it bends, by the cube of the depth [Schwerin 1929].
double pressForce(const scene::OrganConfig& organ, double shear, double radius) {
  if (organ.model != "cloth") return 16.0 / 3.0 * shear * radius * radius;
  const double half = 0.5 * std::min(organ.cloth.width, organ.cloth.length);
  return 3.0 * shear * organ.cloth.thickness * radius * std::pow(radius / half, 2);
}

}  // namespace

double typicalForce(const sim::Simulator& simulator) {
  const scene::Scene& scene = simulator.scene();
  double force = 0.0;
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const double radius = tipRadius(simulator, i);
    for (const scene::OrganConfig& organ : scene.organs) {
      force = std::max(force, pressForce(organ, shearModulus(organ, scene.file), radius));
    }
    const scene::NeedleConfig& needle = scene.instruments[static_cast<std::size_t>(i)].needle;
    if (!needle.link.empty()) force = std::max(force, needle.puncture_force);
  }
  return force > 0.0 && std::isfinite(force) ? force : 1.0;
}

View makeView(const sim::Simulator& simulator) {
  View view;
  SceneBox box = sceneBox(simulator);
  if (!box.empty()) {
    view.box_min = box.min;
    view.box_max = box.max;
  }
  box.min = view.box_min;
  box.max = view.box_max;
  Vec3 tools = towardsTools(simulator, box.middle());
  if (!(tools.norm() > 0.0)) tools = Vec3::UnitZ();
  // A part of the way to the tools is seen, too.
  const Vec3 shown = box.middle() + kShownWay * view.size() * tools.normalized();
  box.add(shown);
  view.focus = box.middle();
  // From the front, and the higher the more the tools come from above.
  const double elevation = std::atan2(tools.z(), tools.head<2>().norm());
  view.yaw = -1.3;
  view.pitch = std::clamp(0.35 * elevation, 0.1, 0.5);
  view.distance = distanceTo(box, view.focus, view.yaw, view.pitch);
  view.arrow_scale = kArrowLength * view.size() / typicalForce(simulator);
  return view;
}

}  // namespace palpate::node
