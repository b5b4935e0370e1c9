// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/state_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "palpate/base/error.h"
#include "sim/slab_scene.h"
#include "support/contains.h"

namespace palpate::io::state_file_test {
namespace {

using test::contains;

class StateFile : public ::testing::Test {
 protected:
  StateFile() {
    const Eigen::VectorXd touching = test::SlabScene::press()[40];
    for (int k = 0; k < 3; ++k) {
      simulator_.step({simulator_.linkPoses(0, touching)}, 0.01);
    }
  }
  std::string file() const { return slab_.folder().path("a.state"); }
  // What is said of a file with these bytes; "" if it is accepted.
  std::string errorOf(const std::string& bytes) {
    slab_.folder().write("a.state", bytes);
    try {
      restoreState(file(), &simulator_);
    } catch (const InputError& error) {
      EXPECT_EQ(error.file(), file());
      return error.what();
    }
    return "";
  }
  // What a simulator of a changed scene says of the state.
  template <class Change>
  std::string errorOfAnother(const Change& change) {
    writeState(file(), simulator_.state());
    scene::Scene scene = slab_.scene();
    change(&scene);
    sim::Simulator other(scene);
    const sim::SimulatorState before = other.state();
    try {
      restoreState(file(), &other);
    } catch (const InputError& error) {
      EXPECT_TRUE(other.state() == before);
      return error.what();
    }
    return "";
  }

  test::SlabScene slab_;
  sim::Simulator simulator_{slab_.scene()};
};

TEST_F(StateFile, GivesTheSameStateBack) {
  const sim::SimulatorState state = simulator_.state();
  writeState(file(), state);
  EXPECT_TRUE(readState(file()) == state);
  EXPECT_FALSE(std::filesystem::exists(file() + ".part"));
  const std::string bytes = test::fileBytes(file());
  for (const char* line : {"palpate state 9\n", "\nscene: slab\n", "\ntime: 0.03 s\n",
                           "\norgans: slab; model: fem; state: fem, 1 organs\n", "\npayload: "}) {
    EXPECT_TRUE(contains(bytes, line)) << line;
  }
}

TEST_F(StateFile, EveryTruncationAndChangedByteIsRefused) {
  writeState(file(), simulator_.state());
  const std::string whole = test::fileBytes(file());
  const sim::SimulatorState before = simulator_.state();
  for (std::size_t n = 0; n < whole.size(); n += n < 300 ? 1 : 997) {
    EXPECT_NE(errorOf(whole.substr(0, n)), "") << n;
    std::string changed = whole;
    changed[n] = static_cast<char>(changed[n] ^ 1);
    EXPECT_NE(errorOf(changed), "") << n;
  }
  EXPECT_TRUE(contains(errorOf(whole.substr(0, whole.size() - 1)), "is cut off or was changed"));
  EXPECT_NE(errorOf(whole + "x"), "");
  EXPECT_TRUE(simulator_.state() == before);
  EXPECT_EQ(errorOf(whole), "");
}

TEST_F(StateFile, SaysWhatAFileIsThatIsNone) {
  for (const char* old :
       {"# palpate state 1\n# time = 1\n", "palpate state 2\n", "palpate state 3\n",
        "palpate state 4\n", "palpate state 5\n", "palpate state 6\n"}) {
    EXPECT_TRUE(contains(errorOf(old), "save it again"));
  }
  EXPECT_TRUE(contains(errorOf("t,x,y\n1,2,3\n"), "is no state"));
  EXPECT_TRUE(contains(errorOf(""), "is no state"));
  EXPECT_TRUE(
      contains(errorOf(std::string("palpate state 9\n") + std::string(1000, '\n')), "is cut off"));
  std::filesystem::remove(file());
  EXPECT_THROW(readState(file()), InputError);
  EXPECT_THROW(readState("/dev/zero"), InputError);
}

TEST_F(StateFile, IsRefusedByAnotherScene) {
  EXPECT_EQ(errorOfAnother([](scene::Scene*) {}), "");
  EXPECT_TRUE(contains(errorOfAnother([](scene::Scene* s) { s->name = "other"; }),
                       "of another scene: 'slab', not 'other'"));
  EXPECT_TRUE(contains(errorOfAnother([](scene::Scene* s) { s->organs[0].name = "liver"; }),
                       "it has organ slab where this has liver"));
  EXPECT_TRUE(contains(errorOfAnother([](scene::Scene* s) {
                         s->organs.push_back(s->organs[0]);
                         s->organs[1].name = "second";
                       }),
                       "it has organ slab where this has slab, second"));
  EXPECT_TRUE(contains(errorOfAnother([](scene::Scene* s) { s->solver.method = "lbfgs"; }),
                       "organ slab: the state is one of 'fem implicit_pcg backward_euler anp "
                       "augmented_lagrangian, 196 points', not of 'fem lbfgs"));
  EXPECT_TRUE(contains(errorOfAnother([](scene::Scene* s) { s->solver.integrator = "bdf2"; }),
                       "backward_euler"));
  EXPECT_TRUE(
      contains(errorOfAnother([](scene::Scene* s) { s->organs[0].element = "tet10"; }), "tet10"));
  // Of the same kind, but with another memory.
  EXPECT_TRUE(contains(errorOfAnother([](scene::Scene* s) {
                         s->organs[0].material.viscoelastic = {{0.3, 0.1}};
                       }),
                       "not one of this scene"));
  EXPECT_TRUE(
      contains(errorOfAnother([](scene::Scene* s) { s->instruments.clear(); }), "not one of"));
}

TEST_F(StateFile, IsNotWrittenWhereItCannotBe) {
  EXPECT_THROW(writeState(slab_.folder().path("no/such/a.state"), simulator_.state()),
               std::runtime_error);
}

// Not even a state that fits at first leaves a simulator half restored.
TEST_F(StateFile, ARestoreThatFailsLeavesAllAsItWas) {
  const sim::SimulatorState before = simulator_.state();
  sim::SimulatorState bad = before;
  bad.models[0].state.bytes.pop_back();
  EXPECT_THROW(simulator_.restore(bad), std::invalid_argument);
  EXPECT_TRUE(simulator_.state() == before);
  bad = before;
  bad.models[0].state.bytes[40] = '\x7f';
  bad.models[0].state.bytes[41] = '\xf0';
  bad.tools.pop_back();
  EXPECT_THROW(simulator_.restore(bad), std::invalid_argument);
  EXPECT_TRUE(simulator_.state() == before);
}

}  // namespace
}  // namespace palpate::io::state_file_test
