// SPDX-License-Identifier: GPL-3.0-or-later
// Energy, gradient and gradient with stiffness of a body, by element and by law, and what a body
// does to remember: time a tetrahedron.
#include <functional>
#include <string>
#include <vector>

#include "body.h"

namespace palpate::micro {
namespace {

constexpr double kStep = 0.01;  // [s]

using Prony = std::vector<material::PronyTerm>;
using Work = std::function<void(Body*, Points*, fem::Stiffness*)>;

void measure(benchmark::State& state, int cells, const std::string& element, const std::string& law,
             int threads, const Prony& prony, const Work& work) {
  ThreadPool pool(threads);
  Body body(cells, element, law, &pool, prony);
  body.elasticity->relax(body.mesh.points);
  body.elasticity->beginStep(kStep);
  Points g(3, body.mesh.numPoints());
  fem::Stiffness K = body.elasticity->makeMatrix();
  work(&body, &g, &K);
  // To and fro: what a body keeps from the last call at the same place is not to be measured.
  Points there = body.x + 1e-6 * body.mesh.points;
  for (auto _ : state) {
    body.x.swap(there);
    work(&body, &g, &K);
  }
  countTets(state, body);
}

void energy(Body* body, Points*, fem::Stiffness*) {
  benchmark::DoNotOptimize(body->elasticity->energy(body->x));
}
void gradient(Body* body, Points* g, fem::Stiffness*) {
  benchmark::DoNotOptimize(body->elasticity->gradient(body->x, g));
}
void gradientAndHessian(Body* body, Points* g, fem::Stiffness* K) {
  benchmark::DoNotOptimize(body->elasticity->gradient(body->x, g));
  body->elasticity->hessian(body->x, fem::Tangent::kExact, K);
}
void projectedHessian(Body* body, Points*, fem::Stiffness* K) {
  body->elasticity->hessian(body->x, fem::Tangent::kProjected, K);
}
void minJacobian(Body* body, Points*, fem::Stiffness*) {
  benchmark::DoNotOptimize(body->elasticity->minJacobian(body->x));
}

// What a cycle has to do for the memory.
void remember(Body* body, Points*, fem::Stiffness*) {
  const auto saved = body->elasticity->saveViscousState();
  body->elasticity->beginStep(kStep);
  body->elasticity->endStep(body->x);
}

void add(const std::string& what, int cells, const std::string& element, const std::string& law,
         int threads, const Work& work, const Prony& prony = {}) {
  const std::string name = what + "/" + element + "/" + law + (prony.empty() ? "" : "/viscous") +
                           "/tets:" + std::to_string(6 * cells * cells * cells) +
                           "/threads:" + std::to_string(threads);
  benchmark::RegisterBenchmark(
      name.c_str(),
      [=](benchmark::State& state) { measure(state, cells, element, law, threads, prony, work); })
      ->UseRealTime()
      ->Unit(benchmark::kMicrosecond);
}

const bool kAdded = [] {
  for (const char* element : {"tet4", "anp", "p1p1"}) {
    for (const char* law : {"stable_neo_hookean", "neo_hookean", "ogden", "mooney_rivlin"}) {
      add("gradient", 15, element, law, 1, gradient);
      add("gradient+hessian", 15, element, law, 1, gradientAndHessian);
    }
    add("energy", 15, element, "stable_neo_hookean", 1, energy);
    add("min_jacobian", 15, element, "stable_neo_hookean", 1, minJacobian);
    add("projected_hessian", 15, element, "stable_neo_hookean", 1, projectedHessian);
  }
  for (const int cells : {6, 9, 20}) {
    add("gradient", cells, "anp", "stable_neo_hookean", 1, gradient);
    add("gradient+hessian", cells, "anp", "stable_neo_hookean", 1, gradientAndHessian);
  }
  for (const char* element : {"tet4", "anp"}) {
    add("gradient", 15, element, "stable_neo_hookean", 2, gradient);
    add("gradient+hessian", 15, element, "stable_neo_hookean", 2, gradientAndHessian);
  }
  const Prony prony = {{0.3, 0.5}, {0.2, 5.0}};
  for (const char* element : {"tet4", "anp", "p1p1"}) {
    for (const char* law : {"stable_neo_hookean", "neo_hookean"}) {
      add("gradient", 15, element, law, 1, gradient, prony);
      add("gradient+hessian", 15, element, law, 1, gradientAndHessian, prony);
    }
  }
  for (const int cells : {9, 15, 20}) {
    add("remember", cells, "anp", "stable_neo_hookean", 1, remember, prony);
    add("remember", cells, "anp", "stable_neo_hookean", 2, remember, prony);
  }
  add("remember", 8, "tet10", "stable_neo_hookean", 1, remember, prony);
  add("gradient", 8, "tet10", "stable_neo_hookean", 1, gradient);
  add("gradient", 8, "tet10p", "stable_neo_hookean", 1, gradient);
  add("gradient", 8, "tet10p", "neo_hookean", 1, gradient);
  add("gradient+hessian", 8, "tet10", "stable_neo_hookean", 1, gradientAndHessian);
  add("gradient+hessian", 8, "tet10p", "stable_neo_hookean", 1, gradientAndHessian);
  return true;
}();

}  // namespace
}  // namespace palpate::micro
