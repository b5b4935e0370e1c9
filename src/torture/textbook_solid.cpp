// SPDX-License-Identifier: GPL-3.0-or-later
#include "textbook_solid.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>
#include <utility>

#include "palpate/material/law.h"
#include "palpate/material/law_list.h"

namespace palpate::torture {
namespace {

// Ends of the edges of mid-edge nodes 4 to 9.
constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

using Weights = Eigen::Vector4d;

// d N / d w, nodes x 4.
Eigen::MatrixXd shapeSlopes(Eigen::Index nodes, const Weights& w) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(nodes, 4);
  for (int a = 0; a < 4; ++a) d(a, a) = nodes == 4 ? 1.0 : 4.0 * w[a] - 1.0;
  for (Eigen::Index k = 4; k < nodes; ++k) {
    const int a = kEdges[k - 4][0], b = kEdges[k - 4][1];
    d(k, a) = 4.0 * w[b];
    d(k, b) = 4.0 * w[a];
  }
  return d;
}

Eigen::VectorXd shapeValues(Eigen::Index nodes, const Weights& w) {
  Eigen::VectorXd N(nodes);
  for (int a = 0; a < 4; ++a) N[a] = nodes == 4 ? w[a] : w[a] * (2.0 * w[a] - 1.0);
  for (Eigen::Index k = 4; k < nodes; ++k) N[k] = 4.0 * w[kEdges[k - 4][0]] * w[kEdges[k - 4][1]];
  return N;
}

// For quadratic tetrahedra the rule of degree 2 [Hammer, Marlowe, Stroud 1956].
std::vector<Weights> integrationPoints(Eigen::Index nodes) {
  if (nodes == 4) return {Weights::Constant(0.25)};
  std::vector<Weights> points(4, Weights::Constant((5.0 - std::sqrt(5.0)) / 20.0));
  for (int q = 0; q < 4; ++q) {
    points[static_cast<std::size_t>(q)][q] = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
  }
  return points;
}

// [Hinton, Rock, Zienkiewicz 1976].
double massFraction(Eigen::Index nodes, Eigen::Index node) {
  if (nodes == 4) return 0.25;
  return node < 4 ? 1.0 / 36.0 : 4.0 / 27.0;
}

template <class Law>
using ThetaOf = typename std::decay_t<Law>::Dilatation;

}  // namespace

TextbookSolid::TextbookSolid(const mesh::CellMesh& rest, const std::string& element,
                             const std::vector<material::Material>& laws, double density,
                             const Mat3& frame)
    : rest_(rest),
      element_(element),
      laws_(laws),
      frame_(frame),
      masses_(Eigen::VectorXd::Zero(rest.numPoints())),
      loaded_(Eigen::VectorXd::Zero(rest.numPoints())) {
  for (const material::Material& law : laws_) {
    const material::Moduli m = material::moduli(law);
    double of_element = m.kappa;
    if (element == "p1p1") of_element = 0.0;
    if (element == "anp" || element == "tet10p") of_element = std::min(m.kappa, 0.5 * m.mu);
    moduli_.push_back({m.mu, m.kappa, of_element});
  }
  for (Eigen::Index e = 0; e < rest_.numCells(); ++e) addElement(e, density);
  if (element != "tet4" && element != "tet10") makePressures();
}

std::size_t TextbookSolid::solidOf(Eigen::Index e) const {
  const auto cell = static_cast<std::size_t>(e);
  return rest_.solid.empty() ? 0 : static_cast<std::size_t>(rest_.solid[cell]);
}

const material::Material& TextbookSolid::lawOf(Eigen::Index e) const { return laws_[solidOf(e)]; }

void TextbookSolid::addElement(Eigen::Index e, double density) {
  const Eigen::Index nodes = rest_.cells.rows();
  std::vector<Point> points;
  double volume = 0.0;
  for (const Weights& w : integrationPoints(nodes)) {
    const Eigen::MatrixXd slopes = shapeSlopes(nodes, w);
    const Eigen::MatrixXd d = slopes.rightCols(3).colwise() - slopes.col(0);
    Mat3 D = Mat3::Zero();
    for (Eigen::Index a = 0; a < nodes; ++a) D += rest_.points.col(rest_.cells(a, e)) * d.row(a);
    const double part = D.determinant() / (nodes == 4 ? 6.0 : 24.0);
    points.push_back({w, d * D.inverse(), part});
    volume += part;
    const Eigen::VectorXd N = shapeValues(nodes, w);
    for (Eigen::Index a = 0; a < nodes; ++a) loaded_[rest_.cells(a, e)] += density * part * N[a];
  }
  for (Eigen::Index a = 0; a < nodes; ++a) {
    masses_[rest_.cells(a, e)] += density * volume * massFraction(nodes, a);
  }
  points_.push_back(std::move(points));
}

// One pressure per corner, and per solid at corners between solids.
void TextbookSolid::makePressures() {
  std::map<std::pair<int, std::size_t>, int> number;
  pressure_.resize(4, rest_.numCells());
  for (Eigen::Index e = 0; e < rest_.numCells(); ++e) {
    for (int a = 0; a < 4; ++a) {
      const auto next = static_cast<int>(number.size());
      pressure_(a, e) =
          number.emplace(std::make_pair(rest_.cells(a, e), solidOf(e)), next).first->second;
    }
  }
  const auto count = static_cast<Eigen::Index>(number.size());
  Eigen::VectorXd volumes = Eigen::VectorXd::Zero(count), kappa = volumes;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index e = 0; e < rest_.numCells(); ++e) {
    const Moduli& m = moduli_[solidOf(e)];
    for (const Point& point : points_[static_cast<std::size_t>(e)]) {
      for (int a = 0; a < 4; ++a) {
        volumes[pressure_(a, e)] += point.w[a] * point.volume;
        kappa[pressure_(a, e)] = m.kappa - m.of_element;
        for (int b = 0; b < 4; ++b) {
          const double mass = point.volume / 20.0 * (a == b ? 2.0 : 1.0);
          const double from_mean = mass - point.volume / 16.0;
          entries.emplace_back(pressure_(a, e), pressure_(b, e), mass / m.kappa + from_mean / m.mu);
        }
      }
    }
  }
  over_volumes_ = kappa.cwiseQuotient(volumes);
  if (element_ != "p1p1") return;
  Eigen::SparseMatrix<double> A(count, count);
  A.setFromTriplets(entries.begin(), entries.end());
  compliance_.compute(A);
}

Mat3 TextbookSolid::deformation(const Point& point, Eigen::Index e, const Points& now) const {
  Mat3 F = Mat3::Zero();
  for (Eigen::Index a = 0; a < rest_.cells.rows(); ++a) {
    F += now.col(rest_.cells(a, e)) * point.gradient.row(a);
  }
  return F * frame_;
}

// Pressures of the corners, from the volume change around each.
Eigen::VectorXd TextbookSolid::pressures(const Points& now) const {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(over_volumes_.size());
  for (Eigen::Index e = 0; e < pressure_.cols(); ++e) {
    for (const Point& point : points_[static_cast<std::size_t>(e)]) {
      const Mat3 F = deformation(point, e, now);
      const double theta = material::visitLaw(
          [&](const auto& law) { return ThetaOf<decltype(law)>::value(F); }, lawOf(e));
      for (int a = 0; a < 4; ++a) c[pressure_(a, e)] += point.w[a] * point.volume * theta;
    }
  }
  if (element_ == "p1p1") return compliance_.solve(c);
  return over_volumes_.cwiseProduct(c);
}

Points TextbookSolid::elasticForces(const Points& now) const {
  Points forces = Points::Zero(3, now.cols());
  const Eigen::VectorXd p = pressures(now);
  for (Eigen::Index e = 0; e < rest_.numCells(); ++e) {
    const double kappa = moduli_[solidOf(e)].of_element;
    for (const Point& point : points_[static_cast<std::size_t>(e)]) {
      const Mat3 F = deformation(point, e, now);
      double pressure = 0.0;
      for (int a = 0; a < 4 && p.size() > 0; ++a) pressure += point.w[a] * p[pressure_(a, e)];
      const Mat3 P = material::visitLaw(
          [&](const auto& law) -> Mat3 {
            using Theta = ThetaOf<decltype(law)>;
            return law.distortionalStress(law.kinematics(F)) +
                   (kappa * Theta::value(F) + pressure) * Theta::gradient(F);
          },
          lawOf(e));
      const Mat3 stress = point.volume * P * frame_.transpose();
      for (Eigen::Index a = 0; a < rest_.cells.rows(); ++a) {
        forces.col(rest_.cells(a, e)) -= stress * point.gradient.row(a).transpose();
      }
    }
  }
  return forces;
}

}  // namespace palpate::torture
