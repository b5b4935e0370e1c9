// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/number.h"
#include "palpate/base/types.h"
#include "palpate/material/material.h"
#include "run_cli.h"
#include "support/contains.h"
#include "support/uniaxial.h"

namespace palpate::solve_command_test {
namespace {

using test::contains;

class SolveCommand : public ::testing::Test {
 protected:
  int solve(const std::string& text) {
    const std::string file = folder.write("case.yaml", text);
    result = test::runCli("solve '" + file + "' --out '" + folder.path("out") + "'");
    return result.status;
  }
  std::string json() const { return test::fileBytes(folder.path("out/result.json")); }
  // The numbers of the list after `key`, from its first appearance after `probe`.
  std::vector<double> numbers(const std::string& probe, const std::string& key) const {
    const std::string text = json();
    std::size_t at = text.find('[', text.find("\"" + key + "\"", text.find("\"" + probe + "\"")));
    std::istringstream list(text.substr(at + 1, text.find(']', at) - at - 1));
    std::vector<double> values;
    std::string cell;
    while (std::getline(list, cell, ',')) values.push_back(std::stod(cell));
    return values;
  }
  test::TempFolder folder;
  test::CliResult result;
};

TEST_F(SolveCommand, StretchedBarAgreesWithTheClosedFormForEveryLaw) {
  for (const std::string& law : material::materialNames()) {
    SCOPED_TRACE(law);
    const material::Constants constants = material::exampleConstants(law);
    const material::Material made = material::makeMaterial(law, constants);
    if (material::needsFibres(made)) continue;  // its sides differ: see test/material
    std::string keys;
    for (const auto& [name, values] : constants) {
      std::string list;
      for (const double value : values) list += (list.empty() ? "" : ", ") + formatNumber(value);
      keys += ", " + name + ": [" + list + "]";
    }
    ASSERT_EQ(solve("mesh: {box: {size: [0.1, 0.1, 1.0], cells: [2, 2, 10]}}\n"
                    "element: tet4\n"
                    "material: {law: " +
                    law + keys +
                    ", density: 1000.0}\n"
                    "boundary:\n"
                    "  - {select: {plane: {axis: x, at: 0}}, displacement: [0, null, null]}\n"
                    "  - {select: {plane: {axis: y, at: 0}}, displacement: [null, 0, null]}\n"
                    "  - {select: {plane: {axis: z, at: 0}}, displacement: [null, null, 0]}\n"
                    "  - {select: {plane: {axis: z, at: 1}}, displacement: [null, null, 0.2]}\n"
                    "analysis: {kind: static, load_steps: 4, tolerance: 1.0e-11}\n"
                    "probes:\n"
                    "  - {name: pull, select: {plane: {axis: z, at: 1}}, quantity: reaction}\n"
                    "  - {name: mid, point: [0.05, 0.05, 0.5]}\n"),
              0)
        << result.err;
    double transverse;
    const double force = 0.01 * test::uniaxialStress(made, 1.2, &transverse);
    EXPECT_NEAR(numbers("pull", "force")[2], force, 1e-8 * force);
    EXPECT_NEAR(numbers("mid", "displacement")[2], 0.1, 1e-9);
    EXPECT_TRUE(contains(json(), "\"status\": \"converged\""));
    EXPECT_TRUE(std::filesystem::exists(folder.path("out/result.vtu")));
  }
}

TEST_F(SolveCommand, RotatesAndMovesWhatIsHeld) {
  ASSERT_EQ(solve("mesh: {box: {size: [0.1, 0.1, 0.2], cells: [2, 2, 4]}}\n"
                  "element: tet4\n"
                  "material: {law: neo_hookean, mu: 1.0e4, kappa: 1.0e5, density: 1000.0}\n"
                  "boundary:\n"
                  "  - {select: {plane: {axis: z, at: 0}}, displacement: [0, 0, 0]}\n"
                  "  - {select: {plane: {axis: z, at: 0.2}}, displacement: [0, 0, 0.01], rotation:"
                  " {axis: [0, 0, 1], origin: [0.05, 0.05, 0.2], angle: 1.57}}\n"
                  "analysis: {kind: static, load_steps: 5}\n"
                  "probes:\n"
                  "  - {name: corner, point: [0.1, 0.05, 0.2]}\n"
                  "  - {name: top, select: {plane: {axis: z, at: 0.2}}, quantity: reaction}\n"
                  "  - {name: foot, select: {plane: {axis: z, at: 0}}, quantity: reaction}\n"),
            0)
      << result.err;
  const std::vector<double> u = numbers("corner", "displacement");
  EXPECT_NEAR(u[0], 0.05 * (std::cos(1.57) - 1.0), 1e-12);
  EXPECT_NEAR(u[1], 0.05 * std::sin(1.57), 1e-12);
  EXPECT_NEAR(u[2], 0.01, 1e-12);
  const auto top = numbers("top", "moment"), foot = numbers("foot", "moment");
  EXPECT_GT(top[2], 0.0);
  EXPECT_NEAR(top[2], -foot[2], 1e-6 * top[2]);
}

TEST_F(SolveCommand, ADynamicCaseComesToItsStaticSag) {
  const std::string body =
      "mesh: {box: {size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}}\n"
      "element: tet4\n"
      "material: {law: neo_hookean, young_modulus: 6.0e3, poisson_ratio: 0.4, density: 1000.0}\n"
      "boundary: [{select: {plane: {axis: z, at: 0}}, displacement: [0, 0, 0]}]\n"
      "gravity: [0, 0, -9.81]\n"
      "probes:\n"
      "  - {name: top, point: [0.05, 0.05, 0.1]}\n"
      "  - {name: foot, select: {plane: {axis: z, at: 0}}, quantity: reaction}\n";
  ASSERT_EQ(solve(body + "analysis: {kind: static}\n"), 0) << result.err;
  const double sag = numbers("top", "displacement")[2];
  EXPECT_NEAR(numbers("foot", "force")[2], 9.81, 1e-6);
  for (const std::string method : {"implicit_pcg", "implicit_direct"}) {
    ASSERT_EQ(solve(body + "analysis: {kind: dynamic, integrator: backward_euler, method: " +
                    method + ", dt: 0.02, duration: 4.0}\n"),
              0)
        << result.err;
    EXPECT_NEAR(numbers("top", "displacement")[2], sag, 1e-3 * std::abs(sag));
    const std::string csv = test::fileBytes(folder.path("out/probes.csv"));
    EXPECT_TRUE(contains(csv, "t,top.ux,top.uy,top.uz,top.sxx"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 202);
  }
}

TEST_F(SolveCommand, WhatDoesNotConvergeIsStatusOneWithItsFiles) {
  EXPECT_EQ(solve("mesh: {box: {size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}\n"
                  "element: tet4\n"
                  "material: {law: neo_hookean, mu: 1.0e4, kappa: 1.0e5, density: 1000.0}\n"
                  "boundary:\n"
                  "  - {select: {plane: {axis: z, at: 0}}, displacement: [0, 0, 0]}\n"
                  "  - {select: {plane: {axis: z, at: 0.1}}, displacement: [0, 0, -0.15]}\n"
                  "analysis: {kind: static, load_steps: 4}\n"
                  "probes: [{name: mid, point: [0.05, 0.05, 0.05]}]\n"),
            1);
  EXPECT_FALSE(contains(json(), "\"status\": \"converged\""));
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/result.vtu")));
  EXPECT_TRUE(contains(result.err, "note: converged for 0")) << result.err;
  EXPECT_TRUE(contains(json(), "\"load_factor\": 0"));
}

TEST_F(SolveCommand, BadCasesAreStatusTwo) {
  const std::string head =
      "mesh: {box: {size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}\n"
      "element: tet4\n"
      "material: {law: neo_hookean, mu: 1.0e4, kappa: 1.0e5, density: 1000.0}\n"
      "analysis: {kind: static}\n";
  EXPECT_EQ(
      solve(head + "boundary: [{select: {plane: {axis: z, at: 7}}, displacement: [0,0,0]}]\n"), 2);
  EXPECT_TRUE(contains(result.err, "boundary[0].select"));
  EXPECT_EQ(solve(head +
                  "boundary: [{select: {plane: {axis: z, at: 0}}, displacement: [null,0,null]}]\n"),
            2);
  EXPECT_TRUE(contains(result.err, "translation along x"));
  EXPECT_EQ(solve(head + "boundary: [{select: {plane: {axis: z, at: 0}}, displacement: [0,0,0]}]\n"
                         "probes: [{name: far, point: [1, 1, 1]}]\n"),
            2);
  EXPECT_TRUE(contains(result.err, "probes[0].point"));
}

// All of the motion in one step is too much; in shorter ones it is not.
TEST_F(SolveCommand, RejectsAStepThatFailsAndTakesShorterOnes) {
  ASSERT_EQ(
      solve("mesh: {box: {size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}}\n"
            "material: {law: neo_hookean, young_modulus: 5.0e3, poisson_ratio: 0.45}\n"
            "boundary:\n"
            "  - {select: {plane: {axis: z, at: 0}}, displacement: [0, 0, 0]}\n"
            "  - {select: {plane: {axis: z, at: 0.1}}, displacement: [0, 0, 0],\n"
            "     rotation: {axis: [0, 0, 1], origin: [0.05, 0.05, 0], angle: 3.0}}\n"
            "analysis: {kind: dynamic, integrator: static, method: implicit_direct, dt: 0.1,\n"
            "           duration: 0.1, max_newton_iterations: 12}\n"),
      0)
      << result.err;
  EXPECT_TRUE(contains(json(), "\"rejected_steps\": ")) << json();
  EXPECT_TRUE(contains(json(), "\"status\": \"converged\""));
}

TEST_F(SolveCommand, SaysStressStretchAndTheEnergyOfRegions) {
  ASSERT_EQ(solve("mesh: {box: {size: [1, 1, 1], cells: [2, 2, 2]}}\n"
                  "element: tet10\n"
                  "material: {law: neo_hookean, mu: 1.0e3, kappa: 1.0e4}\n"
                  "regions:\n"
                  "  - {name: stiff, select: {box: {min: [0, 0, 0.5], max: [1, 1, 1]}},\n"
                  "     material: {law: neo_hookean, mu: 1.0e3, kappa: 1.0e4}}\n"
                  "boundary:\n"
                  "  - {select: {plane: {axis: z, at: 0}}, displacement: [0, 0, 0]}\n"
                  "  - {select: {plane: {axis: z, at: 1}}, displacement: [0.2, 0, 0]}\n"
                  "  - {select: {plane: {axis: y, at: 0}}, displacement: [null, 0, null]}\n"
                  "analysis: {kind: static}\n"
                  "probes:\n"
                  "  - {name: mid, point: [0.5, 0.5, 0.5]}\n"),
            0)
      << result.err;
  const std::vector<double> stress = numbers("mid", "cauchy_stress");
  const double mean = (stress[0] + stress[1] + stress[2]) / 3.0;
  const double deviation =
      std::pow(stress[0] - mean, 2) + std::pow(stress[1] - mean, 2) +
      std::pow(stress[2] - mean, 2) +
      2.0 * (std::pow(stress[3], 2) + std::pow(stress[4], 2) + std::pow(stress[5], 2));
  const std::string text = json();
  const double von_mises = std::stod(text.substr(text.find("\"von_mises\": ") + 13));
  EXPECT_NEAR(von_mises, std::sqrt(1.5 * deviation), 1e-9 * von_mises);
  const std::vector<double> stretches = numbers("mid", "principal_stretches");
  EXPECT_GT(stretches[0], 1.05);
  EXPECT_LT(stretches[2], 0.95);
  const auto energy = [&](const std::string& key) {
    return std::stod(text.substr(text.find("\"" + key + "\": ") + key.size() + 4));
  };
  EXPECT_NEAR(energy("body") + energy("stiff"), energy("strain_energy"), 1e-12);
  EXPECT_GT(energy("stiff"), 0.0);
}

}  // namespace
}  // namespace palpate::solve_command_test
