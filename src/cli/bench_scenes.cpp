// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench_scenes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/formats/surface_io.h"
#include "palpate/formats/trajectory.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/mesh/tet_mesh.h"
#include "shipped.h"

namespace palpate::cli {
namespace {

constexpr double kEdge = 0.1;      // of the cube [m]
constexpr double kRadius = 0.015;  // of the ball that presses it [m]
constexpr double kTip = 0.005;     // of the shipped probe's ball [m]
constexpr double kGap = 0.001;     // between ball and cube at the start [m]
constexpr double kDepth = 0.015;   // to which the ball goes in [m]
constexpr double kThrow = 0.15;    // speed of the beam at the start [m/s]
constexpr double kSpeed = 0.05;    // of the ball, down and then sideways [m/s]
constexpr double kApproach = 1.0;  // what is left out of the recorded palpation [s]

// A ball on three slides; its centre is at (x, y, z) for joints x, y, z.
constexpr const char* kBall = R"(<?xml version="1.0"?>
<robot name="ball">
  <link name="base"/><link name="x_slide"/><link name="y_slide"/>
  <link name="tip"><collision><geometry><sphere radius="RADIUS"/></geometry></collision></link>
  <joint name="x" type="prismatic">
    <parent link="base"/><child link="x_slide"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="100" velocity="10"/>
  </joint>
  <joint name="y" type="prismatic">
    <parent link="x_slide"/><child link="y_slide"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="100" velocity="10"/>
  </joint>
  <joint name="z" type="prismatic">
    <parent link="y_slide"/><child link="tip"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="100" velocity="10"/>
  </joint>
</robot>
)";

void refuseBench(const char* scene, const char* option, const std::string& why) {
  throw InputError("command line", option, "",
                   std::string("has no place in ") + scene + ": " + why);
}

scene::MaterialConfig gel(double young_modulus, double poisson_ratio) {
  scene::MaterialConfig material;
  material.law = "stable_neo_hookean";
  material.constants = {{"young_modulus", {young_modulus}}, {"poisson_ratio", {poisson_ratio}}};
  material.density = 1000.0;
  return material;
}

// About `tets` tetrahedra, six a cell: as many cells as `ratio` says, and along z what fits best.
Eigen::Vector3i cellsFor(int tets, const Eigen::Vector3i& ratio) {
  const double cells = tets / 6.0;
  Eigen::Vector3i n =
      std::max(1, static_cast<int>(std::lround(std::cbrt(cells / ratio.prod())))) * ratio;
  n.z() = std::max(1, static_cast<int>(std::lround(cells / (n.x() * n.y()))));
  return n;
}

// Short edges where a ball of `radius` [m] goes, as far as 1.6 radii from its `way`.
scene::RefinementZoneConfig refinementZone(const BenchChoice& choice, double radius,
                                           mesh::Polyline way) {
  scene::RefinementZoneConfig place;
  place.finest = *choice.finest;
  place.growth = choice.growth.value_or(place.growth);
  place.radius = 1.6 * radius;
  place.where = std::move(way);
  return place;
}

scene::SupportConfig heldAt(int axis, double at, double tolerance) {
  scene::SupportConfig support;
  support.select = mesh::PlaneRegion{axis, at, tolerance};
  return support;
}

// A box of about `tets` tetrahedra, or graded along the tool's `way`; held at z = 0.
scene::OrganConfig box(const Vec3& size, const Eigen::Vector3i& ratio, int tets,
                       const BenchChoice& choice, const std::string& folder,
                       const mesh::Polyline& way = {}) {
  scene::OrganConfig organ;
  organ.name = "body";
  organ.supports = {heldAt(2, 0.0, -1.0)};
  if (!choice.finest) {
    if (choice.edge_length)
      refuseBench("a box", "--edge-length", "give --tets, or --finest beside it");
    const Eigen::Vector3i cells = cellsFor(choice.tets.value_or(tets), ratio);
    formats::writeVtu(folder + "/body.vtu", mesh::boxMesh(size, cells), {}, {});
    organ.tetrahedra = "body.vtu";
  } else {
    if (choice.tets) refuseBench("a graded mesh", "--tets", "give --finest and --edge-length");
    if (way.points.empty()) refuseBench("this scene", "--finest", "no tool touches it");
    const mesh::TetMesh corners = mesh::boxMesh(size, Eigen::Vector3i::Ones());
    formats::writeSurface(folder + "/body.obj",
                          {corners.points, mesh::boundaryTriangles(corners.tets)});
    organ.surface = "body.obj";
    organ.edge_length = {choice.edge_length.value_or(std::max(0.2 * size.x(), *choice.finest)),
                         {refinementZone(choice, kRadius, way)}};
    organ.supports = {heldAt(2, 0.0, 1e-6)};
  }
  organ.material = gel(5.0e3, choice.poisson_ratio.value_or(0.45));
  organ.element = choice.element.value_or(organ.element);
  return organ;
}

void addBall(const std::string& folder, scene::Scene* scene, double radius = kRadius) {
  std::string urdf = kBall;
  urdf.replace(urdf.find("RADIUS"), 6, formatNumber(radius));
  writeFileAtomically(folder + "/ball.urdf", urdf);
  scene::InstrumentConfig ball;
  ball.name = "ball";
  ball.urdf = "ball.urdf";
  ball.control_frame = "tip";
  scene->instruments = {ball};
}

// The ball goes down over the middle of the cube's top and then sideways.
Eigen::VectorXd pressAndSlide(double t) {
  const double down = (kGap + kDepth) / kSpeed;
  const double slid = kSpeed * std::max(0.0, t - down);
  return Vec3(kEdge / 2 + slid, kEdge / 2, kEdge + kRadius + kGap - kSpeed * std::min(t, down));
}

BenchCase cube(const BenchChoice& choice, const std::string& folder) {
  BenchCase made;
  made.scene.gravity.setZero();
  const double down = (kGap + kDepth) / kSpeed, slid = kSpeed * (made.duration - down);
  const Vec3 middle(kEdge / 2, kEdge / 2, kEdge);
  made.scene.organs = {box(Vec3::Constant(kEdge), {1, 1, 1}, 4374, choice, folder,
                           {{middle, middle + slid * Vec3::UnitX()}})};
  addBall(folder, &made.scene);
  made.joints = pressAndSlide;
  return made;
}

BenchCase inclusion(const BenchChoice& choice, const std::string& folder) {
  BenchCase made = cube(choice, folder);
  scene::RegionConfig stiff;
  stiff.name = "inclusion";
  stiff.select = mesh::SphereRegion{Vec3(0.06, 0.05, 0.07), 0.016};
  stiff.material = gel(1.0e5, choice.poisson_ratio.value_or(0.45));
  made.scene.organs[0].regions = {stiff};
  return made;
}

BenchCase capsule(const BenchChoice& choice, const std::string& folder) {
  BenchCase made = cube(choice, folder);
  scene::RegionConfig skin;
  skin.name = "capsule";
  skin.select = mesh::DepthRegion{0.0, 0.006};
  skin.material = gel(1.0e5, choice.poisson_ratio.value_or(0.45));
  made.scene.organs[0].regions = {skin};
  return made;
}

// A membrane of 60 x 40 x 3 mm whose ends are held, 50 kPa, under a ball of 5 mm that goes 6 mm
// down and then along it.
BenchCase flap(const BenchChoice& choice, const std::string& folder) {
  constexpr double radius = 0.005, gap = 0.0005, depth = 0.006, thick = 0.003;  // [m]
  const Vec3 size(0.06, 0.04, thick), start(0.025, 0.02, thick);
  const double down = (gap + depth) / kSpeed;
  BenchCase made;
  made.scene.gravity.setZero();
  made.scene.organs = {box(size, {10, 6, 1}, 2880, choice, folder,
                           {{start, start + kSpeed * (made.duration - down) * Vec3::UnitX()}})};
  scene::OrganConfig& organ = made.scene.organs[0];
  if (choice.finest) organ.edge_length.near[0].radius = 1.6 * radius;
  organ.material = gel(5.0e4, choice.poisson_ratio.value_or(0.45));
  organ.damping.mass = 20.0;
  organ.supports = {heldAt(0, 0.0, 1e-6), heldAt(0, size.x(), 1e-6)};
  addBall(folder, &made.scene, radius);
  made.joints = [=](double t) {
    const Vec3 slid = kSpeed * std::max(0.0, t - down) * Vec3::UnitX();
    return Vec3(start + slid + (radius + gap - kSpeed * std::min(t, down)) * Vec3::UnitZ());
  };
  return made;
}

BenchCase beam(const BenchChoice& choice, const std::string& folder) {
  BenchCase made;
  made.scene.gravity.setZero();
  made.scene.organs = {box(Vec3(0.1, 0.1, 0.4), {1, 1, 4}, 3000, choice, folder)};
  made.start_velocity = Vec3(0.0, -kThrow, 0.0);
  return made;
}

BenchCase rest(const BenchChoice& choice, const std::string& folder) {
  BenchCase made = cube(choice, folder);
  made.scene.gravity = Vec3(0.0, 0.0, -9.81);
  made.joints = [](double) { return Vec3(kEdge / 2, kEdge / 2, 2 * kEdge); };
  return made;
}

// Between the rows of the table; at its ends beyond.
Eigen::VectorXd interpolate(const formats::Trajectory& table, double t) {
  const auto after = std::upper_bound(table.t.begin(), table.t.end(), t);
  if (after == table.t.begin()) return table.values.col(0);
  if (after == table.t.end()) return table.values.rightCols(1);
  const Eigen::Index k = after - table.t.begin();
  const double s = (t - table.t[k - 1]) / (table.t[k] - table.t[k - 1]);
  return (1.0 - s) * table.values.col(k - 1) + s * table.values.col(k);
}

// The shipped scene and its recorded hand; or with the liver meshed to `edge_length` [m] or as was
// chosen, which then never changes.
BenchCase liverOf(std::optional<double> edge_length, const BenchChoice& choice) {
  if (choice.tets) refuseBench("the liver", "--tets", "give --edge-length");
  BenchCase made;
  const std::string file = start::sceneFile("liver_palpation");
  made.scene = scene::readScene(file);
  scene::OrganConfig& organ = made.scene.organs[0];
  const std::string recorded = start::shippedTrajectory(file);
  if (choice.edge_length) edge_length = choice.edge_length;
  if (edge_length || choice.finest) organ.adapt = {};
  if (edge_length) organ.edge_length = {*edge_length, {}};
  if (choice.finest) {
    organ.edge_length.near = {refinementZone(choice, kTip, {})};
    organ.edge_length.near[0].trajectory = recorded;
  }
  if (choice.poisson_ratio) organ.material.constants["poisson_ratio"] = {*choice.poisson_ratio};
  organ.element = choice.element.value_or(organ.element);
  made.scene.solver.threads = 1;
  const auto table = std::make_shared<const formats::Trajectory>(formats::readTrajectory(recorded));
  made.joints = [table](double t) { return interpolate(*table, kApproach + t); };
  made.duration = 4.0;
  return made;
}

BenchCase liver(const BenchChoice& choice, const std::string&) { return liverOf({}, choice); }

template <int micrometres>
BenchCase coarseLiver(const BenchChoice& choice, const std::string&) {
  return liverOf(1.0e-6 * micrometres, choice);
}

}  // namespace

const std::vector<BenchScene>& benchScenes() {
  static const std::vector<BenchScene> kScenes = {
      {"cube", "gel cube of 100 mm, a ball of 15 mm presses it 15 mm deep and slides", 162, cube},
      {"inclusion", "the cube with a ball of 20 times the stiffness under the surface", 750,
       inclusion},
      {"capsule", "the cube with an outer layer of 20 times the stiffness", 750, capsule},
      {"flap", "membrane of 60 x 40 x 3 mm held at both ends, a ball of 5 mm presses and slides",
       360, flap},
      {"beam", "gel beam of 100 x 100 x 400 mm held at one end, thrown sideways at 0.15 m/s", 192,
       beam},
      {"rest", "the cube at rest under its weight, the ball far above", 162, rest},
      {"liver", "the shipped liver, palpated as recorded (1020 nodes, and more at the ball)", 0,
       liver},
      {"liver_500", "the same, coarser (about 500 nodes), with a mesh that never changes", 0,
       coarseLiver<22500>},
      {"liver_150", "the same, coarser still (150 tetrahedra)", 0, coarseLiver<100000>},
  };
  return kScenes;
}

const BenchScene& benchScene(const std::string& name) {
  std::vector<std::string> known;
  for (const BenchScene& scene : benchScenes()) {
    if (name == scene.name) return scene;
    known.push_back(scene.name);
  }
  const std::string nearest = nearestName(name, known);
  throw InputError("command line", "--scene", name,
                   "must be one of " + joinNames(known) +
                       (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

}  // namespace palpate::cli
