// SPDX-License-Identifier: GPL-3.0-or-later
// The beam of `palpate bench --scene beam` in Bullet's deformable bodies: the same tetrahedra, held
// where z = 0, the same start velocity and steps.
//
//     palpate_bullet MESH.vtu OUT KEY=VALUE ...
//
// Into the folder OUT go displacements.bin and summary.json in the form of `palpate bench`.
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
  std::map<std::string, double> number = {{"young_modulus", 5.0e3}, {"poisson_ratio", 0.45},
                                          {"density", 1000.0},      {"throw", 0.15},
                                          {"step", 0.01},           {"duration", 0.5},
                                          {"frame", 0.02},          {"newton", 1},
                                          {"line_search", 0},       {"cg", 200},
                                          {"tolerance", 1e-9}};
  std::string force = "neo_hookean";  // or linear: corotated
};

// Reaches what Bullet keeps to itself: numbers of iterations and tolerances.
class Solver final : public btDeformableBodySolver {
 public:
  explicit Solver(const Settings& settings) {
    m_maxNewtonIterations = static_cast<int>(settings.number.at("newton"));
    m_newtonTolerance = 1e-12f;
    m_cg.m_maxIterations = m_cr.m_maxIterations = static_cast<int>(settings.number.at("cg"));
    m_cg.m_tolerance = m_cr.m_tolerance = static_cast<btScalar>(settings.number.at("tolerance"));
  }
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
    world_.setLineSearch(settings.number.at("line_search") != 0.0);
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

void run(const mesh::TetMesh& mesh, const Settings& settings, const std::string& folder) {
  Beam beam(mesh, settings);
  const double h = settings.number.at("step"), frame = settings.number.at("frame");
  const int cycles = static_cast<int>(std::lround(settings.number.at("duration") / h));
  std::vector<double> milliseconds, frame_times;
  std::ofstream frames(folder + "/displacements.bin", std::ios::binary);
  for (int k = 1; k <= cycles; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    beam.step(h);
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - begin;
    milliseconds.push_back(ms.count());
    const double t = k * h;
    if (std::abs(t / frame - std::round(t / frame)) > 1e-6 && k < cycles) continue;
    const Points u = beam.positions() - mesh.points;
    frames.write(reinterpret_cast<const char*>(u.data()),
                 static_cast<std::streamsize>(static_cast<std::size_t>(u.size()) * sizeof(double)));
    frame_times.push_back(t);
  }
  io::JsonMembers fastest, all(",\n  ");
  const double sum = std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0);
  const Percentiles ms = percentiles(milliseconds);
  fastest.add("median_ms", ms.p50);
  fastest.add("p99_ms", ms.p99);
  fastest.add("max_ms", ms.max);
  fastest.add("ms_per_second", sum / (cycles * h));
  all.add("scene", io::jsonText("beam in Bullet, " + settings.force));
  all.add("tets", static_cast<double>(mesh.numTets()));
  all.add("nodes", static_cast<double>(mesh.numPoints()));
  all.add("fastest", fastest.object());
  all.add("frame_times", io::json(Eigen::Map<const Eigen::VectorXd>(
                             frame_times.data(), static_cast<Eigen::Index>(frame_times.size()))));
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
