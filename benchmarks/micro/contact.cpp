// SPDX-License-Identifier: GPL-3.0-or-later
// What contact costs in a cycle: the search through all surface samples, and the gradient.
#include <string>

#include "body.h"
#include "palpate/contact/contact_potential.h"

namespace palpate::micro {
namespace {

// A ball of 15 mm that is 5 mm deep in the top of the cube.
struct Scene {
  explicit Scene(int cells)
      : body(cells, "tet4", "stable_neo_hookean"),
        triangles(mesh::boundaryTriangles(body.mesh.tets)),
        ball(instrument::Sphere{0.015}),
        contact(contact::sampleSurface(body.mesh.points, triangles, 0.0075),
                contact::makeResponse(contact::ResponseSettings())) {
    Pose X = Pose::Identity();
    X.translation() = Vec3(0.05, 0.05, 0.11);
    contact.setObstacles({{&ball, 0, X, X}});
    contact.findCandidates(body.mesh.points, {0.005});
  }

  Body body;
  Eigen::Matrix3Xi triangles;
  instrument::Geometry ball;
  contact::ContactPotential contact;
};

void search(benchmark::State& state, int cells) {
  Scene scene(cells);
  for (auto _ : state) scene.contact.findCandidates(scene.body.mesh.points, {0.005});
  state.counters["per_sample"] = benchmark::Counter(
      static_cast<double>(scene.contact.samples().size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void gradient(benchmark::State& state, int cells) {
  Scene scene(cells);
  Points g = Points::Zero(3, scene.body.mesh.numPoints());
  for (auto _ : state) {
    benchmark::DoNotOptimize(scene.contact.addGradient(scene.body.mesh.points, &g));
  }
}

void hessian(benchmark::State& state, int cells) {
  Scene scene(cells);
  fem::Stiffness K = scene.body.elasticity->makeMatrix();
  for (auto _ : state) {
    scene.contact.addHessian(scene.body.mesh.points, fem::Tangent::kConvexTerms, &K);
  }
}

void add(const char* what, int cells, void (*run)(benchmark::State&, int)) {
  const std::string name = std::string(what) + "/tets:" + std::to_string(6 * cells * cells * cells);
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    run(state, cells);
  })->Unit(benchmark::kMicrosecond);
}

const bool kAdded = [] {
  for (const int cells : {9, 15, 20}) {
    add("contact_search", cells, search);
    add("contact_gradient", cells, gradient);
    add("contact_hessian", cells, hessian);
  }
  return true;
}();

}  // namespace
}  // namespace palpate::micro
