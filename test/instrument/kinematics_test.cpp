// SPDX-License-Identifier: GPL-3.0-or-later
// Forward kinematics against KDL's own recursive solver, and without allocation.
#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <cstdlib>
#include <kdl/jntarray.hpp>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl_parser/kdl_parser.hpp>
#include <random>

#include "palpate/instrument/instrument.h"
#include "palpate/instrument/joint_mapper.h"
#include "support/source_folder.h"

// Every malloc of the process is counted, Eigen's too; under a sanitizer malloc is not ours.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PALPATE_COUNTS_ALLOCATIONS 1
namespace {
long allocations = 0;
}  // namespace
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace palpate::instrument {
namespace {

std::vector<std::string> urdfFiles() {
  const std::string shipped = test::sourceFolder() + "/config/instruments/";
  std::vector<std::string> files = {shipped + "probe.urdf", shipped + "grasper.urdf"};
  if (const char* data = std::getenv("PALPATE_EXTRA_DATA")) {
    files.push_back(std::string(data) + "/instruments/psm/psm.urdf");
    files.push_back(std::string(data) + "/instruments/omni.urdf");
  }
  return files;
}

/// Positions of all joints of the tree, mimics included, from those of the driven ones.
KDL::JntArray treePositions(const KDL::Tree& tree, const urdf::ModelInterface& model,
                            const std::vector<std::string>& driven, const Eigen::VectorXd& q) {
  KDL::JntArray positions(tree.getNrOfJoints());
  for (const auto& [name, element] : tree.getSegments()) {
    const KDL::Joint& joint = GetTreeElementSegment(element).getJoint();
    if (joint.getType() == KDL::Joint::None) continue;
    double factor = 1.0, offset = 0.0;
    auto at = model.getJoint(joint.getName());
    for (; at->mimic; at = model.getJoint(at->mimic->joint_name)) {
      offset += factor * at->mimic->offset;
      factor *= at->mimic->multiplier;
    }
    for (std::size_t i = 0; i < driven.size(); ++i) {
      if (driven[i] == at->name) {
        positions(GetTreeElementQNr(element)) = factor * q[static_cast<Eigen::Index>(i)] + offset;
      }
    }
  }
  return positions;
}

TEST(Kinematics, AgreesWithKdlsRecursiveSolver) {
  std::mt19937 rng{9};
  std::uniform_real_distribution<double> u(-2.0, 2.0);
  InstrumentOptions options;
  options.collision_meshes.convex_hull = true;  // of the shapes nothing is asked
  for (const std::string& file : urdfFiles()) {
    const Instrument instrument = readInstrument(file, options);
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(file);
    for (auto& [name, link] : model->links_) link->inertial.reset();
    KDL::Tree tree;
    ASSERT_TRUE(kdl_parser::treeFromUrdfModel(*model, tree)) << file;
    KDL::TreeFkSolverPos_recursive solver(tree);
    const auto n = static_cast<Eigen::Index>(instrument.joints().size());
    ASSERT_GT(n, 0) << file;
    std::vector<Pose> X;
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(n, [&] { return u(rng); });
      instrument.linkPoses(q, &X);
      const KDL::JntArray all = treePositions(tree, *model, instrument.jointNames(), q);
      for (std::size_t i = 0; i < X.size(); ++i) {
        KDL::Frame expected;
        ASSERT_EQ(solver.JntToCart(all, expected, instrument.linkNames()[i]), 0);
        for (int r = 0; r < 3; ++r) {
          EXPECT_NEAR(X[i].translation()[r], expected.p[r], 1e-12) << file;
          for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(X[i].linear()(r, c), expected.M(r, c), 1e-12) << file;
          }
        }
      }
    }
  }
}

#ifdef PALPATE_COUNTS_ALLOCATIONS
TEST(Kinematics, AndMappingDoNotAllocateInSteadyState) {
  const Instrument instrument = readInstrument(urdfFiles()[1]);
  const std::vector<std::string> names = instrument.jointNames();
  const std::vector<double> positions(names.size(), 0.1);
  JointMapper mapper(names);
  Eigen::VectorXd q;
  std::vector<Pose> X;
  const auto cycle = [&] {
    const bool ok = mapper.map(names, positions.data(), positions.size(), &q).ok();
    instrument.linkPoses(q, &X);
    return ok;
  };
  ASSERT_TRUE(cycle());
  const long before = allocations;
  bool ok = true;
  for (int i = 0; i < 100; ++i) ok = cycle() && ok;
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(ok);
  X.clear();
  X.shrink_to_fit();
  q.resize(0);
  ASSERT_TRUE(cycle());
  EXPECT_EQ(allocations, before + 2);  // the counter sees both kinds
}
#endif

}  // namespace
}  // namespace palpate::instrument
