// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is saved to a file, and gone on with by another simulator from there, gives the rows
// and the state of one that was not interrupted, to the bit: for every method, integrator and kind
// of memory. To save changes nothing.
#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "palpate/formats/vtu_writer.h"
#include "palpate/io/replay_table.h"
#include "palpate/io/state_file.h"
#include "palpate/tissue/method_facts.h"
#include "sim/slab_scene.h"
#include "support/learned_box.h"

namespace palpate::io::resume_test {
namespace {

constexpr double kStep = 0.01;
constexpr int kCycles = 130;
constexpr int kGoOn = 15;  // cycles after each save

struct Case {
  std::string name;
  std::function<void(scene::Scene*)> change = [](scene::Scene*) {};
  bool islands = false;
  int thrown = -1;  // before this cycle all points get velocities that no solve can follow
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// What of a run can be compared.
struct Record {
  std::vector<std::string> rows;  // of cycles
  int asleep = 0, touching = 0, unsolved = 0;
};

class Resume : public ::testing::TestWithParam<Case> {
 protected:
  Resume() {
    if (GetParam().islands) writeTwoSlabs();
    scene_ = slab_.scene();
    scene_.organs[0].damping.mass = 5.0;
    GetParam().change(&scene_);
  }

  void writeTwoSlabs() const {
    mesh::TetMesh two = mesh::boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(4, 4, 2));
    const Eigen::Index n = two.numPoints(), m = two.numTets();
    two.points.conservativeResize(3, 2 * n);
    two.points.rightCols(n) = two.points.leftCols(n).colwise() + Vec3(0.2, 0.0, 0.0);
    two.tets.conservativeResize(4, 2 * m);
    two.tets.rightCols(m) = two.tets.leftCols(m).array() + static_cast<int>(n);
    formats::writeVtu(slab_.folder().path("slab.vtu"), two, {}, {});
  }

  // Cycles from `begin` up to `end`; `between` is called before each.
  Record run(
      sim::Simulator* simulator, int begin, int end,
      const std::function<void(int)>& between = [](int) {}) const {
    Record done;
    const std::string table = slab_.folder().path("rows.csv");
    CsvWriter csv(table, replayColumns(scene_));
    for (int k = begin; k < end; ++k) {
      if (k == GetParam().thrown) {
        const Points x = simulator->positions(0);
        simulator->setPositions(0, x, Points::Constant(3, x.cols(), 1e200));
      }
      between(k);
      const auto cycle = static_cast<std::size_t>(k);
      const sim::StepResult& result =
          simulator->step({simulator->linkPoses(0, press_[cycle])}, kStep);
      done.asleep += static_cast<int>(result.report.skipped.sleeping_organs);
      done.touching += result.report.contacts > 0;
      done.unsolved += !result.report.usable();
      writeReplayRow(kStep * k, result, 0.0, &csv);
    }
    csv.close();
    std::istringstream lines(test::fileBytes(table));
    for (std::string line; std::getline(lines, line);) done.rows.push_back(line);
    done.rows.erase(done.rows.begin());
    return done;
  }

  test::SlabScene slab_;
  scene::Scene scene_;
  const std::vector<Eigen::VectorXd> press_ = test::SlabScene::press();
};

TEST_P(Resume, GoesOnWithTheSameBits) {
  sim::Simulator whole(scene_);
  const Record uninterrupted = run(&whole, 0, kCycles);
  EXPECT_GT(uninterrupted.touching, 50);
  EXPECT_EQ(uninterrupted.unsolved > 0, GetParam().thrown >= 0);

  const std::vector<int> saved_at = {0, 9, 45, 70, 71, 100};
  std::vector<sim::SimulatorState> states;  // before each cycle
  sim::Simulator saved(scene_);
  const auto file = [&](int k) { return slab_.folder().path("state" + std::to_string(k)); };
  const Record with_saves = run(&saved, 0, kCycles, [&](int k) {
    states.push_back(saved.state());
    if (std::count(saved_at.begin(), saved_at.end(), k)) writeState(file(k), states.back());
  });
  EXPECT_EQ(with_saves.rows, uninterrupted.rows);
  EXPECT_TRUE(saved.state() == whole.state());

  sim::Simulator again(scene_);  // goes on from many, so that nothing of an earlier one is left
  for (const int k : saved_at) {
    sim::Simulator fresh(scene_);
    for (sim::Simulator* simulator : {&fresh, &again}) {
      restoreState(file(k), simulator);
      EXPECT_TRUE(simulator->state() == states[static_cast<std::size_t>(k)]) << "cycle " << k;
      // The throw is in the state already.
      const int end = std::min(k + kGoOn, k < GetParam().thrown ? GetParam().thrown : kCycles);
      const Record resumed = run(simulator, k, end);
      for (int row = k; row < end; ++row) {
        ASSERT_EQ(resumed.rows[static_cast<std::size_t>(row - k)],
                  uninterrupted.rows[static_cast<std::size_t>(row)])
            << "saved at " << k << ", cycle " << row;
      }
      const auto last = static_cast<std::size_t>(end);
      EXPECT_TRUE(end == GetParam().thrown || simulator->state() == states[last]) << "from " << k;
    }
  }
}

void breathe(scene::SupportConfig* support) {
  support->motion.emplace();
  support->motion->amplitude = Vec3(0.001, 0.0, 0.002);
  support->motion->period = 0.7;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& method : tissue::methodNames()) {
    all.push_back({method, [method](scene::Scene* s) { s->solver.method = method; }});
  }
  for (const std::string& integrator : solver::integratorNames()) {
    all.push_back(
        {integrator, [integrator](scene::Scene* s) { s->solver.integrator = integrator; }});
    all.push_back({integrator + "_lossy", [integrator](scene::Scene* s) {
                     s->solver.integrator = integrator;
                     s->organs[0].damping = {2.0, 0.002};
                     s->organs[0].material.viscoelastic = {{0.3, 0.05}, {0.2, 1.0}};
                   }});
  }
  for (const char* method : {"implicit_async", "lbfgs", "tled", "newton_bicgstab"}) {
    all.push_back({std::string("viscous_") + method, [method](scene::Scene* s) {
                     s->solver.method = method;
                     s->organs[0].material.viscoelastic = {{0.3, 0.05}};
                   }});
  }
  for (const char* method : {"implicit_async", "lbfgs"}) {
    all.push_back({std::string("p1p1_") + method, [method](scene::Scene* s) {
                     s->solver.method = method;
                     s->organs[0].element = "p1p1";
                   }});
  }
  all.push_back({"two_threads", [](scene::Scene* s) {
                   s->solver.method = "implicit_async";
                   s->solver.threads = 2;
                 }});
  all.push_back({"quadratic", [](scene::Scene* s) { s->organs[0].element = "tet10"; }});
  all.push_back({"quadratic_nodal", [](scene::Scene* s) { s->organs[0].element = "tet10p"; }});
  all.push_back({"nothing_skipped", [](scene::Scene* s) {
                   static_cast<tissue::SkipSwitches&>(s->solver.skip) = {false, false, false, false,
                                                                         false, false, false};
                 }});
  all.push_back({"two_organs", [](scene::Scene* s) {
                   s->organs.push_back(s->organs[0]);
                   s->organs[1].name = "beside";
                   s->organs[1].pose.position.x() = 0.06;
                   s->organs[1].material.viscoelastic = {{0.3, 0.05}};
                 }});
  for (const std::string& method : tissue::methodNames()) {
    if (method == "linear_precomputed") continue;
    all.push_back({"adaptive_" + method, [method](scene::Scene* s) {
                     s->solver.method = method;
                     s->organs[0].adapt.finest = 0.012;
                   }});
  }
  for (const std::string& integrator : solver::integratorNames()) {
    all.push_back({"adaptive_" + integrator + "_lossy", [integrator](scene::Scene* s) {
                     s->solver.integrator = integrator;
                     s->organs[0].damping = {2.0, 0.002};
                     s->organs[0].material.viscoelastic = {{0.3, 0.05}};
                     s->organs[0].adapt.finest = 0.012;
                     s->solver.threads = 2;
                   }});
  }
  for (const char* method : {"implicit_pcg", "tled"}) {
    all.push_back({std::string("adaptive_quadratic_") + method, [method](scene::Scene* s) {
                     s->solver.method = method;
                     s->organs[0].element = "tet10";
                     s->organs[0].material.viscoelastic = {{0.3, 0.05}};
                     s->organs[0].adapt.finest = 0.015;
                   }});
  }
  for (const std::string& method : tissue::methodNames()) {
    all.push_back({"breathing_" + method, [method](scene::Scene* s) {
                     s->solver.method = method;
                     breathe(&s->organs[0].supports[0]);
                   }});
  }
  for (const std::string& integrator : solver::integratorNames()) {
    all.push_back({"breathing_springs_adaptive_" + integrator, [integrator](scene::Scene* s) {
                     s->solver.integrator = integrator;
                     s->organs[0].damping = {2.0, 0.002};
                     s->organs[0].adapt.finest = 0.012;
                     scene::SupportConfig springs = s->organs[0].supports[0];
                     springs.kind = "springs";
                     springs.springs = {2.0e5, 1.0e5, 50.0, 20.0};
                     breathe(&springs);
                     breathe(&s->organs[0].supports[0]);
                     s->organs[0].supports[0].select =
                         mesh::BoxRegion{Vec3::Constant(-1.0), Vec3(0.02, 1.0, 1e-6)};
                     s->organs[0].supports.push_back(springs);
                   }});
  }
  for (const std::string& integrator : tissue::springSchemeNames()) {
    all.push_back({"springs_" + integrator, [integrator](scene::Scene* s) {
                     s->organs[0].model = "mass_spring";
                     s->organs[0].springs.scheme = integrator;
                     s->organs[0].damping = {10.0, 0.002};
                   }});
  }
  for (const char* model : {"tensor_mass", "sampled_elasticity"}) {
    all.push_back({model, [model](scene::Scene* s) {
                     s->organs[0].model = model;
                     s->organs[0].damping = {10.0, 0.001};
                     s->organs[0].sampling.coarsest = 0.02;
                   }});
  }
  all.push_back({"neural", [](scene::Scene* s) {
                   static const test::LearnedBox learned = test::learnedSlab();
                   s->organs[0].model = "neural";
                   s->organs[0].neural.file = learned.file();
                 }});
  all.push_back({"bem", [](scene::Scene* s) { s->organs[0].model = "bem"; }});
  for (const char* detail : {"residual", "displacement"}) {
    all.push_back({std::string("enriched_") + detail,
                   [detail](scene::Scene* s) { test::beEnriched(detail, s); }});
  }
  for (const char* exchange : {"monolithic", "loop"}) {
    all.push_back(
        {std::string("hybrid_") + exchange, [exchange](scene::Scene* s) {
           s->organs[0].model = "hybrid";
           s->organs[0].damping = {10.0, 0.0};
           s->organs[0].hybrid.exchange = exchange;
           s->organs[0].material.density = 1e5;  // the loop is stable
           s->gravity.setZero();
           s->organs[0].hybrid.region = mesh::BoxRegion{Vec3::Constant(-1.0), Vec3(0.05, 1.0, 1.0)};
         }});
  }
  for (const char* scheme : {"implicit", "symplectic_euler"}) {
    for (const bool rolled : {false, true}) {
      all.push_back({std::string("cloth_") + scheme + (rolled ? "_rolled" : ""),
                     [scheme, rolled](scene::Scene* s) { test::beASheet(scheme, rolled, s); }});
    }
  }
  all.push_back({"springs_of_a_region_breathing", [](scene::Scene* s) {
                   s->organs[0].model = "mass_spring";
                   s->organs[0].springs.scheme = "symplectic_euler";
                   s->organs[0].springs.step = 1e-3;
                   s->organs[0].springs.region = 0.03;
                   breathe(&s->organs[0].supports[0]);
                 }});
  for (const double cut_off : {0.0, 1e-5}) {
    all.push_back({cut_off > 0.0 ? "honeycomb_cut_off" : "honeycomb", [cut_off](scene::Scene* s) {
                     s->organs[0].model = "honeycomb";
                     s->organs[0].honeycomb.cut_off = cut_off;
                     s->organs[0].honeycomb.max_sweeps = 20;
                   }});
  }
  all.push_back({"islands", [](scene::Scene*) {}, true});
  all.push_back({"thrown", [](scene::Scene*) {}, false, 45});
  all.push_back({"thrown_tled", [](scene::Scene* s) { s->solver.method = "tled"; }, false, 45});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Resume, ::testing::ValuesIn(cases()),
                         [](const auto& method) { return method.param.name; });

// Memory of each kind is really there when a case above saves it.
TEST(ResumeCases, AreSavedAsleepAndInContact) {
  const test::SlabScene slab;
  scene::Scene scene = slab.scene();
  scene.organs[0].damping.mass = 5.0;
  sim::Simulator simulator(scene);
  const std::vector<Eigen::VectorXd> press = test::SlabScene::press();
  for (int k = 0; k < 100; ++k) {
    const sim::StepReport report =
        simulator.step({simulator.linkPoses(0, press[static_cast<std::size_t>(k)])}, kStep).report;
    if (k == 8) {
      EXPECT_EQ(report.skipped.sleeping_organs, 1);
    }
    if (k == 44 || k == 99) {
      EXPECT_GT(report.contacts, 0);
    }
  }
}

}  // namespace
}  // namespace palpate::io::resume_test
