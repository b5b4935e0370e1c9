// SPDX-License-Identifier: GPL-3.0-or-later
// What every response must be, those of the table and one that is none of it.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <stdexcept>

#include "palpate/contact/contact_potential.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/tet_mesh.h"
#include "sampled_surfaces.h"
#include "support/contains.h"
#include "support/hold_response.h"
#include "support/no_jumps.h"
#include "support/random.h"

namespace palpate::contact::responses_test {
namespace {

const instrument::Geometry kShapes[] = {instrument::Sphere{0.03}, instrument::Capsule{0.02, 0.01},
                                        instrument::Box{Vec3(0.02, 0.03, 0.025)}, sampledLargeU()};

std::unique_ptr<Response> makeRubbing(const std::string& normal, double teeth,
                                      ResponseSettings settings) {
  settings.model = normal;
  settings.friction_with.usual = {0.5, 0.3, teeth};
  return makeResponse(settings);
}

std::vector<ResponseEntry> allEntries() {
  std::vector<ResponseEntry> all = responses();
  all.push_back(test::kHold);
  all.push_back(
      {"rubbing", [](const ResponseSettings& s) { return makeRubbing("penalty", 0.0, s); }});
  all.push_back({"rubbing_augmented", [](const ResponseSettings& s) {
                   return makeRubbing("augmented_lagrangian", 0.0, s);
                 }});
  all.push_back(
      {"biting", [](const ResponseSettings& s) { return makeRubbing("penalty", 1e6, s); }});
  return all;
}

// A box, in the top of which a shape has been for a step and goes on, turning.
class EveryResponse : public ::testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  EveryResponse() {
    potential.setObstacles({{shape, 0, X_WG, X_WG}});
    potential.findCandidates(x, {0.05});
    potential.beginStep(x);
    potential.endStep(x);
    potential.learn(x, 0.01);
    goOn(&potential);
  }
  static std::unique_ptr<Response> makeOne() {
    return makeResponse({std::get<0>(GetParam()), 1e6, 2e-3}, allEntries());
  }
  std::unique_ptr<ContactPotential> make() const {
    return std::make_unique<ContactPotential>(potential.samples(), makeOne());
  }
  void goOn(ContactPotential* in) const {
    in->setObstacles({{shape, 0, X_WG, X_WG}});
    in->findCandidates(x, {0.05});
    in->beginStep(x);
    Pose X_end = X_WG * Eigen::AngleAxisd(0.02, Vec3(1.0, 2.0, 3.0).normalized());
    X_end.translation() += Vec3(0.3e-3, -0.5e-3, 0.4e-3);
    in->setObstacles({{shape, 0, X_WG, X_end}});
  }
  fem::Stiffness matrix() const {
    return fem::Stiffness(fem::BlockMatrix(static_cast<int>(x.cols()), {}));
  }
  Points gradient(const ContactPotential& of, const Points& at) const {
    Points g = Points::Zero(3, at.cols());
    EXPECT_DOUBLE_EQ(of.addGradient(at, &g), of.value(at));
    return g;
  }

  const instrument::Geometry* shape = &kShapes[std::get<1>(GetParam())];
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.05), Eigen::Vector3i(5, 5, 3));
  const Points& x = mesh.points;
  Pose X_WG = poseFromXyzRpy(Vec3(0.051, 0.047, 0.065), Vec3(0.2, 0.1, 0.3));
  std::unique_ptr<Response> owned = makeOne();
  const Response* response = owned.get();
  ContactPotential potential{sampleSurface(x, mesh::boundaryTriangles(mesh.tets), 0.01),
                             std::move(owned)};
  test::Random random;
};

std::vector<std::string> allNames() {
  std::vector<std::string> names;
  for (const ResponseEntry& entry : allEntries()) names.push_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(TableAndShapes, EveryResponse,
                         ::testing::Combine(::testing::ValuesIn(allNames()),
                                            ::testing::Range(0, 4)));

// What is known of a touch is looked for near that of the one before.
TEST_P(EveryResponse, AnswersInAnyOrder) {
  std::vector<Contact> contacts;
  potential.collect(x, &contacts);
  ASSERT_GT(contacts.size(), 3u);
  std::vector<double> energies;
  for (const Contact& c : contacts) energies.push_back(response->energy(c.touch));
  std::size_t k = 0;
  for (std::size_t n = 0; n < 10 * contacts.size(); ++n) {
    k = (31 * k + n) % contacts.size();
    EXPECT_EQ(response->energy(contacts[k].touch), energies[k]) << k;
    if (!response->hasFriction()) continue;
    Touch other = contacts[k].touch;  // that nothing is known of
    other.number = n % 2 ? 7 : -7;
    response->energy(other);
  }
}

TEST_P(EveryResponse, ForcesAreTheGradientOfTheEnergy) {
  const Points g = gradient(potential, x);
  EXPECT_GT(g.norm(), 0.0);
  constexpr double h = 1e-7;
  for (int trial = 0; trial < 10; ++trial) {
    const Points d = random.points(x.cols(), 1.0);
    const double slope = (potential.value(x + h * d) - potential.value(x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-5 * g.norm() * d.norm());
  }
}

// However far the tissue is drawn away within a step.
TEST_P(EveryResponse, EnergyHasNoJumpsWhereATouchEnds) {
  Points d = Points::Zero(3, x.cols());
  d.row(2).setConstant(-1.0);
  test::expectNoJumps(potential, x, d, 2e-5, 1500);
}

// In a matrix without a pattern: all blocks between nodes are couplings.
TEST_P(EveryResponse, StiffnessIsThatOfTheForces) {
  fem::Stiffness K = matrix();
  potential.addHessian(x, fem::Tangent::kExact, &K);
  EXPECT_FALSE(K.couplings().empty());
  constexpr double h = 1e-8;
  for (int trial = 0; trial < 5; ++trial) {
    const Points d = random.points(x.cols(), 1.0);
    Points Kd;
    K.multiply(d, &Kd);
    const Points expected =
        (gradient(potential, x + h * d) - gradient(potential, x - h * d)) / (2.0 * h);
    EXPECT_LT((Kd - expected).norm(), 1e-4 * Kd.norm());
  }
}

TEST_P(EveryResponse, StiffnessHasAPositiveSemidefinitePart) {
  std::vector<Contact> contacts;
  potential.collect(x, &contacts);
  ASSERT_GT(contacts.size(), 5U);
  for (const Contact& c : contacts) {
    const Mat3 exact = potential.stiffness(c);
    EXPECT_LT((exact - exact.transpose()).norm(), 1e-12 * exact.norm());
    const Mat3 H = response->stiffness(c.touch, fem::Tangent::kConvexTerms);
    EXPECT_GE(H.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12 * H.norm());
    EXPECT_EQ(response->stiffness(c.touch, fem::Tangent::kProjected), H);
    EXPECT_LT((potential.convexStiffness(c, exact) - H).norm(), 1e-12 * H.norm());
  }
}

TEST_P(EveryResponse, ObstacleFeelsTheOppositeOfTheTissue) {
  const Points g = gradient(potential, x);
  std::vector<Contact> contacts;
  potential.collect(x, &contacts);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (const Contact& c : contacts) {
    sum += c.force_W;
    moment += c.touch.p_W.cross(c.force_W);
  }
  for (Eigen::Index i = 0; i < x.cols(); ++i) moment -= Vec3(x.col(i)).cross(Vec3(g.col(i)));
  EXPECT_LT((sum - g.rowwise().sum()).norm(), 1e-12 * sum.norm());
  EXPECT_LT(moment.norm(), 1e-12 * sum.norm());
}

// What is skipped would have added nothing, and what is out of reach does not answer.
TEST_P(EveryResponse, AnswersTheSameWithoutSkips) {
  const Points g = gradient(potential, x);
  std::vector<Contact> some, all;
  potential.collect(x, &some);
  for (const Contact& c : some) EXPECT_LT(c.touch.gap, potential.reach());
  potential.setSkips(false, false);
  EXPECT_EQ(gradient(potential, x), g);
  potential.collect(x, &all);
  EXPECT_EQ(all.size(), some.size());
}

TEST_P(EveryResponse, GoesOnFromWhatWasSavedToTheSameBits) {
  StateWriter saved;
  potential.save(&saved);
  const auto other = make();
  StateReader reader(saved.bytes());
  other->restore(&reader);
  reader.finish();
  goOn(other.get());
  EXPECT_EQ(gradient(*other, x), gradient(potential, x));
  EXPECT_EQ(other->value(x), potential.value(x));
  StateWriter again;
  other->save(&again);
  EXPECT_EQ(again.bytes(), saved.bytes());
  if (saved.bytes().empty()) return;
  StateReader cut(std::string_view(saved.bytes()).substr(0, saved.bytes().size() - 1));
  EXPECT_THROW(other->restore(&cut), std::invalid_argument);
}

TEST_P(EveryResponse, IsAsNewWhenItForgets) {
  const auto fresh = make();
  goOn(fresh.get());
  potential.forget();
  goOn(&potential);
  EXPECT_EQ(gradient(*fresh, x), gradient(potential, x));
}

TEST(Responses, HaveAMemoryWhereTheyHold) {
  ContactPotential potential(sampleSurface(Points::Zero(3, 3), Eigen::Matrix3Xi::Zero(3, 0), 0.0),
                             makeResponse({"hold", 1e6, 2e-3}, allEntries()));
  StateWriter held, none;
  potential.save(&held);
  EXPECT_FALSE(held.bytes().empty());
  ContactPotential(potential.samples(), makeResponse({"penalty"})).save(&none);
  EXPECT_TRUE(none.bytes().empty());
}

TEST(Responses, OfUnknownNamesAreRefused) {
  EXPECT_EQ(responseNames().front(), ResponseSettings().model);
  try {
    makeResponse({"glue", 1.0, 1.0});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::contains(
        error.what(), "contact.model = glue: must be one of augmented_lagrangian, penalty"));
  }
}

}  // namespace
}  // namespace palpate::contact::responses_test
