// SPDX-License-Identifier: GPL-3.0-or-later
// A default stands in one place; whoever else has the setting takes it from there.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "palpate/analysis/case.h"
#include "palpate/scene/scene.h"
#include "palpate/solver/minimizer_list.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::defaults_test {
namespace {

void expectSame(const solver::StepSettings& a, const solver::StepSettings& b) {
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.integrator, b.integrator);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.tolerance, b.tolerance);
  EXPECT_EQ(a.position_tolerance, b.position_tolerance);
  EXPECT_EQ(a.max_newton_iterations, b.max_newton_iterations);
  EXPECT_EQ(a.linear_tolerance, b.linear_tolerance);
  EXPECT_EQ(a.max_linear_iterations, b.max_linear_iterations);
}

TEST(Defaults, OfATissueAreThoseOfAScene) {
  const tissue::FemSettings tissue;
  const scene::Scene scene;
  expectSame(tissue, scene.solver);
  EXPECT_EQ(tissue.contact.stiffness, scene.contact.stiffness);
  EXPECT_EQ(tissue.contact.smoothing, scene.contact.smoothing);
  EXPECT_EQ(tissue.element, scene::OrganConfig().element);
  EXPECT_EQ(tissue.mass_damping, scene::OrganConfig().damping.mass);
  EXPECT_EQ(tissue.stiffness_damping, scene::OrganConfig().damping.stiffness);
}

TEST(Defaults, OfCasesAndSolversAreThoseOfASceneWhereTheyMeanTheSame) {
  const solver::StepSettings scene = scene::SolverConfig();
  EXPECT_EQ(solver::NewtonSettings().max_iterations, scene.max_newton_iterations);
  EXPECT_EQ(solver::NewtonSettings().linear_tolerance, scene.linear_tolerance);
  EXPECT_EQ(solver::MinimizerSettings().max_linear_iterations, scene.max_linear_iterations);
  EXPECT_EQ(analysis::DynamicAnalysis().method, scene.method);
  EXPECT_EQ(analysis::DynamicAnalysis().max_newton_iterations, scene.max_newton_iterations);
  EXPECT_EQ(analysis::StaticAnalysis().tolerance, solver::StaticSettings().tolerance);
  EXPECT_EQ(analysis::Case().element, scene::OrganConfig().element);
  EXPECT_EQ(scene::HapticsConfig().max_force, haptics::WrenchFilterSettings().max_force);
  EXPECT_EQ(scene::RatesConfig().ramp, haptics::WrenchFilterSettings().ramp);
}

TEST(Defaults, AreTheFirstOfTheirLists) {
  const solver::StepSettings settings;
  EXPECT_EQ(settings.method, tissue::methodNames().front());
  EXPECT_EQ(settings.method, solver::minimizerNames().front());
  EXPECT_EQ(settings.integrator, solver::integratorNames().front());
}

// A member with one of these names that is set to something else than nothing.
std::map<std::string, std::set<std::string>> headersWithDefaults(const std::string& names) {
  const std::regex member("^  (?:double|int|std::string) (" + names +
                          ")(?: =|\\{) *(\"[^\"]+\"|[0-9][0-9.e+-]*)");
  const std::regex nothing("0(\\.0*)?");
  std::map<std::string, std::set<std::string>> found;
  namespace fs = std::filesystem;
  for (const char* folder : {"/include", "/src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(test::sourceFolder() + folder)) {
      if (entry.path().extension() != ".h") continue;
      std::istringstream lines(test::fileBytes(entry.path().string()));
      for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (!std::regex_search(line, match, member)) continue;
        if (std::regex_match(match[2].str(), nothing)) continue;
        found[match[1]].insert(entry.path().filename());
      }
    }
  }
  return found;
}

TEST(Defaults, AreWrittenOnce) {
  const auto found = headersWithDefaults(
      "method|integrator|element|step|tolerance|position_tolerance|max_newton_iterations|"
      "linear_tolerance|max_linear_iterations|stiffness|smoothing|max_force|max_torque|"
      "max_force_rate|ramp");
  const std::map<std::string, std::set<std::string>> expected = {
      {"method", {"step_settings.h"}},
      {"integrator", {"step_settings.h"}},
      {"step", {"step_settings.h"}},
      {"tolerance", {"step_settings.h", "static_solver.h"}},  // of steps, of equilibria
      {"position_tolerance", {"step_settings.h"}},
      {"max_newton_iterations", {"step_settings.h", "static_solver.h"}},
      {"linear_tolerance", {"step_settings.h"}},
      {"max_linear_iterations", {"step_settings.h"}},
      {"stiffness", {"response_settings.h"}},
      {"smoothing", {"response_settings.h"}},
      {"max_force", {"wrench_filter.h"}},
      {"max_torque", {"wrench_filter.h"}},
      {"max_force_rate", {"wrench_filter.h"}},
      {"ramp", {"wrench_filter.h"}},
  };
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace palpate::defaults_test
