// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodal_pressure.h"

#include <algorithm>

#include "palpate/base/for_all.h"

namespace palpate::fem {
namespace {

using Element = Eigen::Matrix4d;

// Integral of N_m N_n / kappa + (N_m - 1/4)(N_n - 1/4) / mu over a tetrahedron.
Element compliance(double volume, double mu, double kappa) {
  const Element mass = volume / 20.0 * (Element::Identity() + Element::Ones());
  const Element mean = volume / 16.0 * Element::Ones();
  return mass / kappa + (mass - mean) / mu;
}

}  // namespace

template <int N>
NodalPressure::Elements NodalPressure::elementsOf(const RestShape<N>& shape) {
  constexpr int kPoints = RestShape<N>::kPoints;
  Elements elements{shape.nodes, Eigen::MatrixXd(kPoints, shape.nodes.cols()),
                    Eigen::Matrix4Xd(4, kPoints)};
  for (int q = 0; q < kPoints; ++q) elements.shares.col(q) = Tetrahedron<N>::point(q);
  for (Eigen::Index e = 0; e < shape.nodes.cols(); ++e) {
    for (int q = 0; q < kPoints; ++q) elements.volumes(q, e) = shape.points[e][q].volume;
  }
  return elements;
}

NodalPressure::NodalPressure(Kind kind, const std::vector<double>& kappa, Elements elements,
                             const Composition& composition)
    : of_(std::move(elements)) {
  numberPressures(composition);
  buildRows();
  c_ = p_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(solid_.size()));
  if (kind == Kind::kAveraged) {
    makeAveraged(kappa);
  } else {
    makeStabilised(kappa, composition);
  }
}

void NodalPressure::makeAveraged(const std::vector<double>& kappa) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(c_.size());
  for (Eigen::Index n = 0; n < weights.size(); ++n) {
    double volume = 0.0;
    for (const int* e = elements_.begin(n); e != elements_.end(n); ++e) {
      volume += of_.shares.row(ownCorner(*e, static_cast<int>(n))).dot(of_.volumes.col(*e));
    }
    weights[n] = kappa[solid_[n]] / volume;
  }
  metric_ = std::make_shared<PressureMetric>(PressureMetric::diagonal(weights));
}

void NodalPressure::makeStabilised(const std::vector<double>& kappa,
                                   const Composition& composition) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index e = 0; e < pressure_.cols(); ++e) {
    const int solid = solid_[pressure_(0, e)];
    const Element local = compliance(
        of_.volumes.col(e).sum(), material::moduli(composition.solids[solid].law).mu, kappa[solid]);
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        entries.emplace_back(pressure_(a, e), pressure_(b, e), local(a, b));
      }
    }
  }
  Eigen::SparseMatrix<double> all(c_.size(), c_.size());
  all.setFromTriplets(entries.begin(), entries.end());
  metric_ = std::make_shared<PressureMetric>(PressureMetric::inverseOf(all));
}

void NodalPressure::numberPressures(const Composition& composition) {
  const auto solidOf = [&](Eigen::Index e) {
    return composition.solid_of.empty() ? 0 : composition.solid_of[static_cast<std::size_t>(e)];
  };
  // Number of each pair (node, solid), in that order.
  const auto num_solids = static_cast<std::size_t>(composition.solids.size());
  std::vector<int> number(num_solids * static_cast<std::size_t>(of_.nodes.maxCoeff() + 1), -1);
  const auto numberOf = [&](Eigen::Index e, int a) -> int& {
    return number[num_solids * static_cast<std::size_t>(of_.nodes(a, e)) +
                  static_cast<std::size_t>(solidOf(e))];
  };
  for (Eigen::Index e = 0; e < of_.nodes.cols(); ++e) {
    for (int a = 0; a < 4; ++a) numberOf(e, a) = 0;
  }
  for (std::size_t k = 0; k < number.size(); ++k) {
    if (number[k] < 0) continue;
    number[k] = static_cast<int>(solid_.size());
    solid_.push_back(static_cast<int>(k % num_solids));
  }
  pressure_.resize(4, of_.nodes.cols());
  std::vector<int> targets, sources;
  for (Eigen::Index e = 0; e < of_.nodes.cols(); ++e) {
    for (int a = 0; a < 4; ++a) {
      pressure_(a, e) = numberOf(e, a);
      targets.push_back(pressure_(a, e));
      sources.push_back(static_cast<int>(e));
    }
  }
  elements_ = Sources<int>(targets, sources, static_cast<int>(solid_.size()));
}

void NodalPressure::buildRows() {
  pattern_ = std::make_shared<VolumeStiffness::Pattern>();
  pattern_->start.push_back(0);
  std::vector<int>& nodes = pattern_->node;
  constexpr int kUnseen = -1, kSeen = -2;
  std::vector<int> entry(static_cast<std::size_t>(of_.nodes.maxCoeff() + 1), kUnseen);
  entry_.resize(4 * numNodes(), pressure_.cols());
  own_entry_.resize(solid_.size());
  for (std::size_t n = 0; n < solid_.size(); ++n) {
    const int first = pattern_->start.back();
    for (const int* e = elements_.begin(n); e != elements_.end(n); ++e) {
      for (int i : of_.nodes.col(*e)) {
        if (entry[i] == kUnseen) nodes.push_back(i);
        entry[i] = kSeen;
      }
    }
    std::sort(nodes.begin() + first, nodes.end());
    pattern_->start.push_back(static_cast<int>(nodes.size()));
    for (int k = first; k < pattern_->start.back(); ++k) entry[nodes[k]] = k;
    for (const int* e = elements_.begin(n); e != elements_.end(n); ++e) {
      const int own = ownCorner(*e, static_cast<int>(n));
      for (int b = 0; b < numNodes(); ++b) {
        entry_(numNodes() * own + b, *e) = entry[of_.nodes(b, *e)];
      }
      own_entry_[n] = rowEntry(*e, own, own);
    }
    for (int k = first; k < pattern_->start.back(); ++k) entry[nodes[k]] = kUnseen;
  }
}

// Corner of element `e` with the pressure `n`.
int NodalPressure::ownCorner(int e, int n) const {
  const auto corners = pressure_.col(e);
  return static_cast<int>(std::find(corners.begin(), corners.end(), n) - corners.begin());
}

void NodalPressure::prepareRows() {
  std::vector<int> targets, sources;
  for (std::size_t n = 0; n < solid_.size(); ++n) {
    for (const int* e = elements_.begin(n); e != elements_.end(n); ++e) {
      const int own = ownCorner(*e, static_cast<int>(n));
      for (int b = 0; b < numNodes(); ++b) {
        targets.push_back(rowEntry(*e, own, b));
        sources.push_back((4 * *e + own) * numNodes() + b);
      }
    }
  }
  row_sources_ = Sources<int>(targets, sources, static_cast<int>(pattern_->node.size()));
}

void NodalPressure::setDilatations(const std::vector<double>& theta, ThreadPool* pool) {
  forAll(pool, solid_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      double sum = 0.0;
      for (const int* e = elements_.begin(n); e != elements_.end(n); ++e) {
        const int own = ownCorner(*e, static_cast<int>(n));
        for (int q = 0; q < numPoints(); ++q) {
          sum += of_.shares(own, q) * of_.volumes(q, *e) * theta[numPoints() * *e + q];
        }
      }
      c_[static_cast<Eigen::Index>(n)] = sum;
    }
  });
  updatePressures();
}

double* NodalPressure::clearVolumeChanges() {
  c_.setZero();
  return c_.data();
}

void NodalPressure::addEnergyBySolid(Eigen::VectorXd* energies) const {
  for (std::size_t n = 0; n < solid_.size(); ++n) {
    const auto i = static_cast<Eigen::Index>(n);
    (*energies)[solid_[n]] += 0.5 * c_[i] * p_[i];
  }
}

double NodalPressure::at(std::size_t e, const Eigen::Vector4d& w) const {
  const Eigen::Vector4i corners = pressure_.col(static_cast<Eigen::Index>(e));
  return w[0] * p_[corners[0]] + w[1] * p_[corners[1]] + w[2] * p_[corners[2]] +
         w[3] * p_[corners[3]];
}

void NodalPressure::completeRows(ThreadPool* pool, VolumeStiffness* stiffness) const {
  forAll(pool, solid_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const int first = pattern_->start[p], count = pattern_->start[p + 1] - first;
      stiffness->rows.col(own_entry_[p]) =
          -stiffness->rows.middleCols(first, count).rowwise().sum();
    }
  });
}

VolumeStiffness NodalPressure::makeStiffness() const {
  VolumeStiffness stiffness;
  stiffness.pattern = pattern_;
  stiffness.metric = metric_;
  stiffness.rows.setZero(3, static_cast<Eigen::Index>(pattern_->node.size()));
  return stiffness;
}

void NodalPressure::gatherRows(const Eigen::MatrixXd& gradients, ThreadPool* pool,
                               VolumeStiffness* stiffness) const {
  stiffness->factor = 1.0;
  const int n = numNodes();
  forAll(pool, row_sources_.numTargets(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Vec3 sum = Vec3::Zero();
      for (const int* s = row_sources_.begin(k); s != row_sources_.end(k); ++s) {
        const int node = *s % n, corner = *s / n % 4, e = *s / n / 4;
        for (int q = 0; q < numPoints(); ++q) {
          sum += of_.shares(corner, q) * gradients.block<3, 1>(3 * (n * q + node), e);
        }
      }
      stiffness->rows.col(static_cast<Eigen::Index>(k)) = sum;
    }
  });
}

template NodalPressure::Elements NodalPressure::elementsOf(const RestShape<4>&);
template NodalPressure::Elements NodalPressure::elementsOf(const RestShape<10>&);

}  // namespace palpate::fem
