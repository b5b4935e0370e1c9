// SPDX-License-Identifier: GPL-3.0-or-later
// What a case that can be read asks of its body in vain.
#include <gtest/gtest.h>

#include "palpate/analysis/case.h"
#include "palpate/analysis/case_solver.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::analysis::case_refusals_test {
namespace {

using test::hasProblem;

class CaseRefusals : public ::testing::Test {
 protected:
  std::vector<Problem> problemsWith(const std::string& from, const std::string& to) const {
    std::string text = R"(mesh: {box: {size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}
element: tet4
material: {law: neo_hookean, young_modulus: 1.0e4, poisson_ratio: 0.3}
boundary:
  - {select: {plane: {axis: z, at: 0.0}}, displacement: [0, 0, 0]}
  - {select: {plane: {axis: z, at: 0.1}}, pressure: 10.0}
analysis: {kind: static}
probes:
  - {name: mid, point: [0.05, 0.05, 0.05]}
  - {name: support, select: {plane: {axis: z, at: 0.0}}, quantity: reaction}
)";
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const Case problem = readCase(folder_.write("case.yaml", text));
    return test::problemsOf([&] { solveCase(problem, 1); });
  }

  test::TempFolder folder_;
};

TEST_F(CaseRefusals, AMeshThatIsNotThere) {
  EXPECT_TRUE(hasProblem(problemsWith("{box: {size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}",
                                      "{file: \"package://no_such_package/bar.msh\"}"),
                         "mesh.file", "no_such_package"));
}

TEST_F(CaseRefusals, FibresWithoutDirections) {
  EXPECT_TRUE(hasProblem(problemsWith("law: neo_hookean, young_modulus: 1.0e4, poisson_ratio: 0.3",
                                      "law: holzapfel_gasser_ogden, mu: 1.0e4, kappa: 1.0e5, k1: "
                                      "1.0e4, k2: 1.0, dispersion: 0.1, angle: 30"),
                         "material", "the law needs directions"));
}

TEST_F(CaseRefusals, AStaticBodyThatIsNotHeld) {
  EXPECT_TRUE(hasProblem(problemsWith("displacement: [0, 0, 0]", "displacement: [null, null, 0]"),
                         "boundary", "it leaves translation along x"));
}

TEST_F(CaseRefusals, SelectionsThatFindNothing) {
  EXPECT_TRUE(hasProblem(problemsWith("at: 0.1}}, pressure", "at: 0.2}}, pressure"),
                         "boundary[1].select", "at least one node"));
  EXPECT_TRUE(hasProblem(
      problemsWith("plane: {axis: z, at: 0.1}", "sphere: {center: [0, 0, 0.1], radius: 0.01}"),
      "boundary[1].select", "selects 1 nodes but no face"));
  EXPECT_TRUE(hasProblem(problemsWith("[0.05, 0.05, 0.05]", "[0.05, 0.05, 0.15]"),
                         "probes[0].point", "inside the mesh"));
  EXPECT_TRUE(hasProblem(problemsWith("select: {plane: {axis: z, at: 0.0}}, quantity",
                                      "select: {plane: {axis: z, at: 0.3}}, quantity"),
                         "probes[1].select", "at least one node"));
}

}  // namespace
}  // namespace palpate::analysis::case_refusals_test
