// SPDX-License-Identifier: GPL-3.0-or-later
// The beam of `palpate bench --scene beam` in Bullet's deformable bodies: the same tetrahedra, held
// where z = 0, the same start velocity and steps.
//
//     palpate_bullet MESH.vtu OUT KEY=VALUE ...
//
// Into the folder OUT go displacements.bin and summary.json in the form of `palpate bench`. The
// keys are the numbers of Settings, and force=neo_hookean or linear.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableLinearElasticityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "palpate/base/percentiles.h"
#include "palpate/formats/tet_io.h"
#include "palpate/io/json.h"
#include "palpate/material/constants.h"

namespace palpate::peers {
namespace {

struct Settings {
  std::map<std::string, double> number = {{"young_modulus", 5.0e3},
                                          {"poisson_ratio", 0.45},
                                          {"density", 1000.0},
                                          {"throw", 0.15},
                                          {"step", 0.01},
                                          {"duration", 0.5},
                                          {"frame", 0.02},
                                          {"newton", 1},
                                          {"cg", 400},
                                          {"tolerance", 1e-6},
                                          {"repeat", 1}};
  std::string force = "neo_hookean";  // or linear: corotated
};

// A step by Newton's method with Bullet's forces and conjugate gradients, which compare r.z, the
// residual's norm squared (z: r over the nodes' masses), with the tolerance times that of the start
// or times 1, whichever is less. Here a linear solve ends, as palpate's does, where the norm is a
// given part of that at the start, and iterations are counted.
class Solver final : public btDeformableBodySolver {
 public:
  explicit Solver(const Settings& settings) : tolerance_(settings.number.at("tolerance")) {
    m_maxNewtonIterations = static_cast<int>(settings.number.at("newton"));
    m_cg.m_maxIterations = static_cast<int>(settings.number.at("cg"));
  }

  int iterations() const { return iterations_; }

  void solveDeformableConstraints(btScalar h) override {
    for (int newton = 0; newton < m_maxNewtonIterations; ++newton) {
      updateState();
      forEachNode([&](int i, btScalar inverse_mass) {
        m_ddv[i].setZero();
        m_residual[i].setZero();
        if (inverse_mass > 0.0f) m_residual[i] = m_dv[i] / -inverse_mass;
      });
      m_objective->computeResidual(h, m_residual);
      double square = 0.0;
      forEachNode([&](int i, btScalar inverse_mass) {
        square += double{m_residual[i].length2()} * double{inverse_mass};
      });
      m_cg.m_tolerance = static_cast<btScalar>(tolerance_ * tolerance_ * std::max(1.0, square));
      iterations_ += m_cg.solve(*m_objective, m_ddv, m_residual);
      updateDv();
    }
    updateVelocity();
  }

 private:
  template <class Function>
  void forEachNode(const Function& function) const {
    int i = 0;
    for (int b = 0; b < m_softBodies.size(); ++b) {
      const btSoftBody::tNodeArray& nodes = m_softBodies[b]->m_nodes;
      for (int k = 0; k < nodes.size(); ++k) function(i++, nodes[k].m_im);
    }
  }

  double tolerance_;  // of the residual's norm
  int iterations_ = 0;
};

btVector3 vector(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

// Bullet's energy is the stable neo-Hookean one with its logarithm, of which these are the
// constants that give Hooke's at small strain [Smith, de Goes, Kim 2018, sec. 3.4].
std::unique_ptr<btDeformableLagrangianForce> makeForce(const Settings& s) {
  const material::Moduli moduli =
      material::moduliFromYoung(s.number.at("young_modulus"), s.number.at("poisson_ratio"));
  const double mu = moduli.mu, lambda = moduli.lambda();
  if (s.force == "linear") {
    return std::make_unique<btDeformableLinearElasticityForce>(
        static_cast<btScalar>(mu), static_cast<btScalar>(lambda), 0.0f, 0.0f);
  }
  return std::make_unique<btDeformableNeoHookeanForce>(
      static_cast<btScalar>(4.0 / 3.0 * mu), static_cast<btScalar>(lambda + 5.0 / 6.0 * mu), 0.0f);
}

/// The world with the beam in it.
class Beam {
 public:
  Beam(const mesh::TetMesh& mesh, const Settings& settings)
      : dispatcher_(&configuration_),
        solver_(settings),
        world_(&dispatcher_, &broadphase_, &constraints_, &configuration_, &solver_),
        force_(makeForce(settings)) {
    constraints_.setDeformableSolver(&solver_);
    world_.setGravity(btVector3(0, 0, 0));
    world_.getWorldInfo().m_gravity = btVector3(0, 0, 0);
    world_.setImplicit(true);
    world_.setUseProjection(true);  // of held nodes, which the implicit steps need
    body_ = makeBody(mesh, settings);
    world_.addSoftBody(body_);
    world_.addForce(body_, force_.get());
  }
  ~Beam() {
    world_.removeSoftBody(body_);
    delete body_;
  }
  Beam(const Beam&) = delete;
  Beam& operator=(const Beam&) = delete;

  void step(double h) {
    world_.stepSimulation(static_cast<btScalar>(h), 1, static_cast<btScalar>(h));
  }
  int iterations() const { return solver_.iterations(); }
  Points positions() const {
    Points x(3, body_->m_nodes.size());
    for (int i = 0; i < body_->m_nodes.size(); ++i) {
      for (int k = 0; k < 3; ++k) x(k, i) = body_->m_nodes[i].m_x[k];
    }
    return x;
  }

 private:
  btSoftBody* makeBody(const mesh::TetMesh& mesh, const Settings& settings) {
    const auto nodes = static_cast<int>(mesh.numPoints());
    std::vector<btVector3> x;
    x.reserve(static_cast<std::size_t>(nodes));
    std::vector<btScalar> mass(static_cast<std::size_t>(nodes), 0.0f);
    for (int i = 0; i < nodes; ++i) x.push_back(vector(mesh.points.col(i)));
    for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
      const Eigen::Vector4i corners = mesh.tets.col(t);
      const double quarter =
          settings.number.at("density") * mesh::signedVolume(mesh.points, corners) / 4.0;
      for (int k = 0; k < 4; ++k) mass[corners[k]] += static_cast<btScalar>(quarter);
    }
    auto* body = new btSoftBody(&world_.getWorldInfo(), nodes, x.data(), mass.data());
    for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
      const Eigen::Vector4i c = mesh.tets.col(t);
      body->appendTetra(c[0], c[1], c[2], c[3]);
    }
    body->initializeDmInverse();
    body->m_tetraScratches.resize(body->m_tetras.size());
    body->m_tetraScratchesTn.resize(body->m_tetras.size());
    body->m_sleepingThreshold = 0.0f;
    body->m_cfg.kDP = 0.0f;
    body->m_cfg.kDG = 0.0f;
    body->m_cfg.collisions = 0;
    body->setActivationState(DISABLE_DEACTIVATION);
    const btVector3 thrown = vector(Vec3(0.0, -settings.number.at("throw"), 0.0));
    for (int i = 0; i < nodes; ++i) {
      if (mesh.points(2, i) < 1e-9) {
        body->setMass(i, 0.0f);  // held
      } else {
        body->m_nodes[i].m_v = body->m_nodes[i].m_vn = thrown;
      }
    }
    return body;
  }

  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btDeformableMultiBodyConstraintSolver constraints_;
  Solver solver_;
  btDeformableMultiBodyDynamicsWorld world_;
  std::unique_ptr<btDeformableLagrangianForce> force_;
  btSoftBody* body_ = nullptr;
};

// What one run from the start gave.
struct Repeat {
  std::vector<double> milliseconds;  // of each step
  std::vector<double> frame_times;   // [s]
  int iterations = 0;
};

Repeat swing(const mesh::TetMesh& mesh, const Settings& settings, std::ofstream* frames) {
  Beam beam(mesh, settings);
  Repeat repeat;
  const double h = settings.number.at("step"), frame = settings.number.at("frame");
  const int cycles = static_cast<int>(std::lround(settings.number.at("duration") / h));
  for (int k = 1; k <= cycles; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    beam.step(h);
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - begin;
    repeat.milliseconds.push_back(ms.count());
    const double t = k * h;
    if (std::abs(t / frame - std::round(t / frame)) > 1e-6 && k < cycles) continue;
    repeat.frame_times.push_back(t);
    if (frames == nullptr) continue;
    const Points u = beam.positions() - mesh.points;
    const auto bytes = static_cast<std::streamsize>(u.size() * sizeof(double));
    frames->write(reinterpret_cast<const char*>(u.data()), bytes);
  }
  repeat.iterations = beam.iterations();
  return repeat;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::string timesJson(const std::vector<double>& milliseconds, double duration) {
  io::JsonMembers json;
  const Percentiles ms = percentiles(milliseconds);
  json.add("median_ms", ms.p50);
  json.add("p99_ms", ms.p99);
  json.add("max_ms", ms.max);
  json.add("ms_per_second", sum(milliseconds) / duration);
  return json.object();
}

void run(const mesh::TetMesh& mesh, const Settings& settings, const std::string& folder) {
  std::ofstream frames(folder + "/displacements.bin", std::ios::binary);
  const Repeat first = swing(mesh, settings, &frames);
  const int repeats = static_cast<int>(settings.number.at("repeat"));
  std::vector<double> fastest = first.milliseconds, pooled = first.milliseconds;
  for (int k = 1; k < repeats; ++k) {
    const Repeat next = swing(mesh, settings, nullptr);
    pooled.insert(pooled.end(), next.milliseconds.begin(), next.milliseconds.end());
    if (sum(next.milliseconds) < sum(fastest)) fastest = next.milliseconds;
  }
  const double duration = first.frame_times.back();
  io::JsonMembers all(",\n  ");
  all.add("scene", io::jsonText("beam in Bullet, " + settings.force));
  all.add("tets", static_cast<double>(mesh.numTets()));
  all.add("nodes", static_cast<double>(mesh.numPoints()));
  all.add("cycles", static_cast<double>(first.milliseconds.size()));
  all.add("repeats", static_cast<double>(repeats));
  all.add("duration", duration);
  all.add("fastest", timesJson(fastest, duration));
  all.add("pooled", timesJson(pooled, duration * repeats));
  all.add("linear_iterations", static_cast<double>(first.iterations));
  all.add("frame_times",
          io::json(Eigen::Map<const Eigen::VectorXd>(
              first.frame_times.data(), static_cast<Eigen::Index>(first.frame_times.size()))));
  std::ofstream(folder + "/summary.json") << "{\n  " << all.text() << "\n}\n";
}

}  // namespace
}  // namespace palpate::peers

int main(int argc, char** argv) {
  using palpate::peers::Settings;
  if (argc < 3) {
    std::fputs("usage: palpate_bullet MESH.vtu OUT [KEY=VALUE ...]\n", stderr);
    return 2;
  }
  Settings settings;
  for (int i = 3; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string key = word.substr(0, word.find('='));
    const std::string value = word.substr(std::min(word.size(), key.size() + 1));
    if (key == "force") {
      settings.force = value;
    } else if (settings.number.count(key)) {
      settings.number[key] = std::atof(value.c_str());
    } else {
      std::fprintf(stderr, "palpate_bullet: no setting %s\n", key.c_str());
      return 2;
    }
  }
  try {
    palpate::peers::run(palpate::formats::readTetMesh(argv[1]), settings, argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpate_bullet: %s\n", error.what());
    return 1;
  }
  return 0;
}
