// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/result_json.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/error.h"
#include "support/temp_folder.h"

namespace palpate::io::result_json_test {
namespace {

analysis::SolveResult example() {
  analysis::SolveResult result;
  result.status = "converged";
  result.load_steps = 20;
  result.newton_iterations = 80;
  result.residual = 1e-10;
  result.strain_energy = 0.25;
  result.min_jacobian = 0.9;
  result.seconds = {{"assembly", 0.5}, {"total", 1.5}};
  analysis::ProbeResult mid, support;
  mid.name = "mid";
  mid.displacement = Vec3(0, 0.5, -1);
  mid.cauchy_stress = (Eigen::Matrix<double, 6, 1>() << 1, 2, 3, 4, 5, 6).finished();
  support.name = "support";
  support.force = Vec3(0, 0, 7);
  support.moment = Vec3(0.1, 0, 0);
  result.probes = {mid, support};
  return result;
}

TEST(ResultJson, HasTheKeysInTheirOrder) {
  EXPECT_EQ(resultJson(example()), R"({
  "status": "converged",
  "load_steps": 20,
  "newton_iterations": 80,
  "residual": 1e-10,
  "strain_energy": 0.25,
  "min_jacobian": 0.9,
  "seconds": {"assembly": 0.5, "total": 1.5},
  "probes": {
    "mid": {"displacement": [0, 0.5, -1], "cauchy_stress": [1, 2, 3, 4, 5, 6]},
    "support": {"force": [0, 0, 7], "moment": [0.1, 0, 0]}
  }
}
)");
}

TEST(ResultJson, NumbersThatAreNoneAreNull) {
  analysis::SolveResult result = example();
  result.residual = std::nan("");
  result.strain_energy = INFINITY;
  result.probes[0].displacement = Vec3(0, std::nan(""), 0);
  const std::string text = resultJson(result);
  EXPECT_NE(text.find("\"residual\": null"), std::string::npos);
  EXPECT_NE(text.find("\"strain_energy\": null"), std::string::npos);
  EXPECT_NE(text.find("[0, null, 0]"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(ResultJson, TextIsEscaped) {
  analysis::SolveResult result;
  result.status = "a\"b\\c\nd";
  const std::string text = resultJson(result);
  EXPECT_NE(text.find(R"("a\"b\\c\u000ad")"), std::string::npos) << text;
  EXPECT_NE(text.find("\"probes\": {}"), std::string::npos);
}

TEST(ResultJson, GoesToAFile) {
  const test::TempFolder folder;
  writeResultJson(folder.path("result.json"), example());
  EXPECT_EQ(test::fileBytes(folder.path("result.json")), resultJson(example()));
  EXPECT_THROW(writeResultJson(folder.path("no/result.json"), example()), InputError);
}

}  // namespace
}  // namespace palpate::io::result_json_test
