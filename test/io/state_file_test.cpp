// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/state_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "palpate/base/error.h"

namespace palpate::io {
namespace {

namespace fs = std::filesystem;

class StateFile : public ::testing::Test {
 protected:
  StateFile() : folder_(fs::temp_directory_path() / ("state_file_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    state_.time = 0.1 + 0.2;
    for (const int n : {4, 2}) {
      state_.positions.push_back(Points::Random(3, n));
      state_.velocities.push_back(Points::Random(3, n) * 1e-9);
    }
  }
  ~StateFile() override { fs::remove_all(folder_); }

  std::string file() const { return (folder_ / "state.csv").string(); }
  std::string text() const {
    std::ifstream in(file());
    std::stringstream s;
    s << in.rdbuf();
    return s.str();
  }
  std::string errorOf(const std::string& content) const {
    std::ofstream(file()) << content;
    try {
      readState(file(), names_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  const std::vector<std::string> names_ = {"liver", "gall"};
  fs::path folder_;
  sim::SimulatorState state_;
};

TEST_F(StateFile, GivesTheSameBitsBack) {
  writeState(file(), names_, state_);
  const sim::SimulatorState read = readState(file(), names_);
  EXPECT_EQ(read.time, state_.time);
  ASSERT_EQ(read.positions.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.positions[i], state_.positions[i]);
    EXPECT_EQ(read.velocities[i], state_.velocities[i]);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(StateFile, EveryTruncationIsAnErrorAndNoCrash) {
  writeState(file(), names_, state_);
  const std::string whole = text();
  for (std::size_t n = 0; n + 1 < whole.size(); n += 7) {
    EXPECT_NE(errorOf(whole.substr(0, n)), "") << n;
  }
  EXPECT_EQ(errorOf(whole), "");
}

TEST_F(StateFile, SaysWhatIsWrongAndWhere) {
  writeState(file(), names_, state_);
  const std::string whole = text();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string s = whole;
    s.replace(s.find(from), from.size(), to);
    return errorOf(s);
  };
  EXPECT_NE(with("palpate state 1", "palpate state 9").find("line 1"), std::string::npos);
  EXPECT_NE(with("time = ", "time = nan").find("line 2"), std::string::npos);
  EXPECT_NE(with("liver,0,", "liver,1,").find("expected 0"), std::string::npos);
  EXPECT_NE(with("liver,0,", "lung,0,").find("liver, gall"), std::string::npos);
  EXPECT_NE(with("liver,0,", "liver,0,inf,").find("finite"), std::string::npos);
  EXPECT_THROW(readState((folder_ / "none").string(), names_), InputError);
}

TEST_F(StateFile, RefusesToWriteWhatIsNotFiniteOrWhereItCannot) {
  sim::SimulatorState bad = state_;
  bad.velocities[1](0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(writeState(file(), names_, bad), std::runtime_error);
  EXPECT_FALSE(fs::exists(file()));
  EXPECT_THROW(writeState((folder_ / "no/such/state.csv").string(), names_, state_),
               std::runtime_error);
}

}  // namespace
}  // namespace palpate::io
