// SPDX-License-Identifier: GPL-3.0-or-later
// The table of figures is what the report, the message and the page say.
#include "palpate/tissue/figures.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "palpate/contact/signed_distance.h"
#include "palpate/sim/lockstep.h"
#include "slab_scene.h"
#include "support/contains.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::sim::figures_test {
namespace {

using tissue::Figure;
using tissue::Merge;
using tissue::Over;

std::string sourceFile(const std::string& name) {
  return test::fileBytes(test::sourceFolder() + "/" + name);
}

struct MessageField {
  std::string type, name, comment;
};

std::vector<MessageField> messageFields() {
  std::vector<MessageField> fields;
  std::istringstream lines(sourceFile("msg/StepReport.msg"));
  const std::regex field("^([A-Za-z0-9_/]+) ([a-z_]+) *(?:# (.*))?$");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, field)) fields.push_back({match[1], match[2], match[3]});
  }
  return fields;
}

TEST(Figures, AreTheFieldsOfTheMessage) {
  std::set<std::string> others = {"header", "state", "cycle_ms"};
  for (std::size_t k = 0; k < kNumPhases; ++k) {
    others.insert(std::string(toString(static_cast<Phase>(k))) + "_ms");
  }
  for (const tissue::Skip& skip : tissue::skips()) {
    if (skip.count) others.insert("skipped_" + std::string(skip.counter));
  }
  std::set<std::string> shown;
  for (const MessageField& field : messageFields()) {
    if (others.count(field.name)) continue;
    const auto& all = reportFigures();
    const auto figure =
        std::find_if(all.begin(), all.end(), [&](const auto& f) { return field.name == f.name; });
    ASSERT_NE(figure, all.end()) << field.name;
    ASSERT_NE(figure->message, nullptr) << field.name;
    EXPECT_EQ(field.type, figure->message) << field.name;
    EXPECT_EQ(field.comment, figure->doc) << field.name;
    shown.insert(field.name);
  }
  for (const Figure<StepReport>& figure : reportFigures()) {
    EXPECT_EQ(shown.count(figure.name) > 0, figure.message != nullptr) << figure.name;
  }
}

// Members of a struct that hold one number or a status.
long countMembers(const std::string& header, const std::string& structure) {
  const std::string text = sourceFile("include/palpate/" + header);
  const std::size_t begin = text.find("struct " + structure + " ");
  const std::string body = text.substr(begin, text.find("\n};", begin) - begin);
  const std::regex member("\n  (int|double|std::uint64_t|solver::SolveStatus) [a-z_]+ = ");
  return std::distance(std::sregex_iterator(body.begin(), body.end(), member),
                       std::sregex_iterator());
}

TEST(Figures, AreAllOfTheStructs) {
  const long of_step = countMembers("tissue/figures.h", "StepFigures");
  EXPECT_EQ(of_step, static_cast<long>(tissue::stepFigures().size()));
  EXPECT_EQ(of_step + countMembers("sim/step_report.h", "StepReport"),
            static_cast<long>(reportFigures().size()));
}

TEST(Figures, AreInThePageWithTheirRules) {
  const std::string page = sourceFile("docs/architecture.md");
  for (const Figure<StepReport>& f : reportFigures()) {
    const auto& parts = tissue::stepFigures();
    const bool of_parts = std::any_of(parts.begin(), parts.end(), [&](const auto& part) {
      return std::string(part.name) == f.name;
    });
    const std::string row = "| `" + std::string(f.name) + "` | " +
                            (of_parts ? toString(f.over_parts) : "-") + " | " +
                            toString(f.over_organs) + " | " + toString(f.over_sub_steps) + " | " +
                            std::regex_replace(f.doc, std::regex("\\|"), "\\|") + " |\n";
    EXPECT_TRUE(test::contains(page, row)) << row;
  }
}

TEST(Figures, AreMergedByTheirRules) {
  EXPECT_EQ(tissue::merged(Merge::kSum, 2.0, 3.0), 5.0);
  EXPECT_EQ(tissue::merged(Merge::kLargest, 2, 3), 3);
  EXPECT_EQ(tissue::merged(Merge::kLeast, 2.0, 3.0), 2.0);
  EXPECT_EQ(tissue::merged(Merge::kRootOfSquares, 3.0, 4.0), 5.0);
  EXPECT_EQ(tissue::merged(Merge::kLast, 3.0, 2.0), 2.0);
  EXPECT_EQ(tissue::merged(Merge::kLargest, solver::SolveStatus::kDeadline,
                           solver::SolveStatus::kConverged),
            solver::SolveStatus::kDeadline);
}

TEST(Figures, OfOrgansAndPartsAreOne) {
  tissue::StepFigures a, b;
  a.residual = 3.0;
  b.residual = 4.0;
  a.newton_iterations = b.newton_iterations = 2;
  b.min_jacobian = 0.5;
  b.time_steps = 4;
  b.phases[Phase::kAssembly] = 1.0;
  tissue::StepFigures organs = a, parts = a;
  tissue::mergeFigures(Over::kOrgans, b, &organs);
  tissue::mergeFigures(Over::kParts, b, &parts);
  EXPECT_EQ(organs.residual, 4.0);
  EXPECT_EQ(parts.residual, 5.0);
  for (const tissue::StepFigures& all : {organs, parts}) {
    EXPECT_EQ(all.newton_iterations, 4);
    EXPECT_EQ(all.min_jacobian, 0.5);
    EXPECT_EQ(all.time_steps, 4);
    EXPECT_EQ(all.phases[Phase::kAssembly], 1.0);
  }
}

TEST(SkipFigures, OfPartsCountASleepingOneAsLeftOut) {
  tissue::TissueStep asleep, awake, organ;
  asleep.slept = true;
  asleep.distant_samples = 3;
  awake.satisfied = true;
  awake.distant_samples = 4;
  organ.slept = organ.satisfied = true;
  tissue::mergeSkips(Over::kParts, asleep, &organ);
  tissue::mergeSkips(Over::kParts, awake, &organ);
  EXPECT_FALSE(organ.slept);
  EXPECT_TRUE(organ.satisfied);
  EXPECT_EQ(organ.sleeping_islands, 1);
  EXPECT_EQ(organ.distant_samples, 7);
  tissue::mergeSkips(Over::kOrgans, asleep, &organ);
  EXPECT_EQ(organ.sleeping_islands, 1);
}

// An input that is cut into four steps, against these steps one by one. The ball goes up and out,
// so the worst figures are not those of the last step.
TEST(Figures, OfSubStepsAreThoseOfAllOfThem) {
  const test::SlabScene slab;
  const std::vector<Eigen::VectorXd> press = test::SlabScene::press();
  const scene::Scene scene = slab.scene("contact: {model: penalty}\n");  // whose depth changes most
  Simulator cut(scene), single(scene);
  Lockstep lockstep(&cut);
  const LinkPoses from = cut.linkPoses(0, press[30]), to = cut.linkPoses(0, press[5]);
  for (int k = 0; k <= 30; ++k) {
    single.step({cut.linkPoses(0, press[k])}, 0.01);
  }
  cut.restore(single.state());
  lockstep.advance(0.0, {from});
  single.step({from}, 0.01);
  const StepReport all = lockstep.advance(0.04, {to}).report;
  ASSERT_EQ(lockstep.parts(), 4);
  int newton = 0;
  double deepest = 0.0, imbalance = 0.0, residual = 0.0, tolerance = 0.0, least = 1.0;
  StepReport last;
  for (int k = 1; k <= 4; ++k) {
    LinkPoses poses = to;
    for (std::size_t l = 0; l < to.size(); ++l) {
      poses[l] = k < 4 ? contact::interpolate(from[l], to[l], k / 4.0) : to[l];
    }
    last = single.step({poses}, 0.01).report;
    newton += last.newton_iterations;
    deepest = std::max(deepest, last.max_penetration);
    imbalance = std::max(imbalance, last.imbalance);
    residual = std::max(residual, last.residual);
    tolerance = std::max(tolerance, last.tolerance);
    least = std::min(least, last.min_jacobian);
  }
  ASSERT_GT(deepest, last.max_penetration);
  ASSERT_GT(imbalance, last.imbalance);
  ASSERT_GT(residual, last.residual);
  ASSERT_LT(least, last.min_jacobian);
  EXPECT_EQ(all.newton_iterations, newton);
  EXPECT_EQ(all.max_penetration, deepest);
  EXPECT_EQ(lockstep.result().instruments[0].max_penetration, deepest);
  EXPECT_EQ(all.imbalance, imbalance);
  EXPECT_EQ(all.residual, residual);
  EXPECT_EQ(all.tolerance, tolerance);
  EXPECT_EQ(all.min_jacobian, least);
  EXPECT_EQ(all.contacts, last.contacts);
  EXPECT_EQ(all.elastic_energy, last.elastic_energy);
  EXPECT_EQ(all.time, last.time);
}

}  // namespace
}  // namespace palpate::sim::figures_test
