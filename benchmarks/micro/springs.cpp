// SPDX-License-Identifier: GPL-3.0-or-later
// Springs in explicit steps: the forces of about 10,000, and cycles of a millisecond of an organ of
// them that a ball presses, as a whole and in its region.
#include <benchmark/benchmark.h>

#include <limits>

#include "palpate/tissue/model_list.h"
#include "tissue/models/springs/spring_elasticity.h"
#include "tissue/models/springs/tet_network.h"

namespace palpate {
namespace {

mesh::TetMesh block() { return mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i(11, 11, 11)); }

fem::Composition soft() {
  return fem::Composition::uniform(
      material::makeMaterial("neo_hookean", {{"young_modulus", {6e3}}, {"poisson_ratio", {0.25}}}));
}

void springForces(benchmark::State& state) {
  const mesh::TetMesh mesh = block();
  std::vector<std::string> notes;
  tissue::SpringElasticity springs(mesh, soft(),
                                   tissue::tetNetwork(mesh, Pose::Identity(), soft(), {}, &notes));
  Points x = mesh.points, g;
  x.row(2) *= 0.98;
  for (auto _ : state) benchmark::DoNotOptimize(springs.gradient(x, &g));
  state.counters["springs"] = springs.springs().size();
  state.counters["ns_per_spring"] = benchmark::Counter(
      1e-9 * springs.springs().size(),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(springForces)->Unit(benchmark::kMicrosecond);

// `region` in millimetres; 0: all.
void springCycle(benchmark::State& state) {
  const mesh::TetMesh mesh = block();
  tissue::OrganDescription organ;
  organ.name = "block";
  organ.tetrahedra = [&] { return mesh; };
  organ.free = [](const Points& X) {
    fem::FreeMask free = fem::FreeMask::Ones(3, X.cols());
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      if (X(2, i) == 0.0) free.col(i).setZero();
    }
    return free;
  };
  organ.surroundings = [&](const mesh::TetMesh& m) {
    return tissue::Surroundings(organ.free(m.points));
  };
  organ.composition = [](const mesh::TetMesh&) { return soft(); };
  organ.damping.mass = 20.0;
  organ.springs.scheme = "symplectic_euler";
  organ.springs.region = 1e-3 * static_cast<double>(state.range(0));
  tissue::ModelDescription description;
  description.organs = {organ};
  description.settings.sample_spacing = 0.005;
  const auto tissue = tissue::makeModel("mass_spring", description);
  const instrument::Geometry ball = instrument::Sphere{0.008};
  double t = 0.0;
  const auto at = [](double time) {
    return poseFromXyzRpy(Vec3(0.05, 0.05, 0.109 - std::min(0.05 * time, 0.005)), Vec3::Zero());
  };
  int sub_steps = 0;
  for (; t < 0.2; t += 1e-3) tissue->step({{&ball, 0, at(t), at(t + 1e-3)}}, 1e-3);
  for (auto _ : state) {
    sub_steps = tissue->step({{&ball, 0, at(t), at(t)}}, 1e-3).sweep_stages;
  }
  state.counters["sub_steps"] = sub_steps;
}
BENCHMARK(springCycle)->Arg(0)->Arg(20)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace palpate
