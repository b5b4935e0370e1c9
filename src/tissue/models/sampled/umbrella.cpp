// SPDX-License-Identifier: GPL-3.0-or-later
#include "umbrella.h"

#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

// Of a particle's cube: nearer to it, what holds it is as if it were so far away.
constexpr double kNearest = 0.25;

}  // namespace

Umbrella::Umbrella(const material::Moduli& moduli, double density, const std::string& weights)
    : symmetric_(weights == "consistent") {
  const double mu = moduli.mu, lambda = moduli.kappa - 2.0 / 3.0 * mu;
  lambda_ = lambda;
  mu_ = mu;
  wave_speed_ = std::sqrt((lambda + 2.0 * mu) / density);
  laplacian_ = mu;
  divergence_ = lambda + mu;
  if (!symmetric_) return;
  laplacian_ = 3.0 * mu - 1.5 * (lambda + mu);
  divergence_ = 7.5 * (lambda + mu);
  if (laplacian_ < 0.0) {
    laplacian_ = 0.0;
    divergence_ = 6.0 * 9.0 * moduli.kappa * mu / (3.0 * moduli.kappa + mu);
  }
}

void Umbrella::build(const ParticleTree& tree, const std::vector<int>& leaves,
                     const std::vector<Anchor>& anchors) {
  links_.clear();
  std::vector<int> at(tree.particles().size(), -1);
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    at[static_cast<std::size_t>(leaves[k])] = static_cast<int>(k);
  }
  const auto count = static_cast<Eigen::Index>(leaves.size());
  lengths_.setZero(count);
  counts_.setZero(count);
  const auto X = [&](int leaf) {
    return tree.particles()[static_cast<std::size_t>(leaves[static_cast<std::size_t>(leaf)])].X;
  };
  for (int a = 0; a < static_cast<int>(count); ++a) {
    for (const int n : tree.neighbours(leaves[static_cast<std::size_t>(a)])) {
      const int b = at[static_cast<std::size_t>(n)];
      if (b < a) continue;
      const Vec3 way = X(b) - X(a);
      const double length = way.norm();
      links_.push_back({a, b, way / length, length, 0.0, 1.0});
      for (const int end : {a, b}) {
        lengths_[end] += length;
        counts_[end] += 1.0;
      }
    }
  }
  const auto weight = [&](int leaf) {
    const double volume =
        tree.particles()[static_cast<std::size_t>(leaves[static_cast<std::size_t>(leaf)])].volume;
    return lengths_[leaf] > 0.0 ? 2.0 * volume / lengths_[leaf] : 0.0;
  };
  for (Link& link : links_) {
    const double a = weight(link.a), b = weight(link.b);
    const double w = (symmetric_ ? 0.5 * (a + b) : a) / link.across;  // the length, until now
    link.across = w * laplacian_;
    link.along = w * (laplacian_ + divergence_);
    link.of_b = symmetric_ ? 1.0 : b / a;
  }
  for (const Anchor& anchor : anchors) {
    const double area = anchor.area.norm();
    const Vec3 normal = anchor.area / area;
    const double size =
        tree.particles()[static_cast<std::size_t>(leaves[static_cast<std::size_t>(anchor.leaf)])]
            .size;
    const double distance = std::max(normal.dot(anchor.X - X(anchor.leaf)), kNearest * size);
    links_.push_back({anchor.leaf, -1, normal, area / distance * mu_,
                      area / distance * (lambda_ + 2.0 * mu_), 0.0});
    counts_[anchor.leaf] += 1.0;
  }
}

void Umbrella::forces(const Points& d, Points* f, Vec3* on_anchors) const {
  f->setZero(3, d.cols());
  on_anchors->setZero();
  Vec3 on_b;
  for (const Link& link : links_) {
    const Vec3 way = (link.b < 0 ? Vec3::Zero() : Vec3(d.col(link.b))) - d.col(link.a);
    const Vec3 on_a = force(link, way, &on_b);
    f->col(link.a) += on_a;
    if (link.b < 0) {
      *on_anchors -= on_a;
    } else {
      f->col(link.b) += on_b;
    }
  }
}

double Umbrella::energy(const Points& d) const {
  double sum = 0.0;
  Vec3 on_b;
  for (const Link& link : links_) {
    const Vec3 way = (link.b < 0 ? Vec3::Zero() : Vec3(d.col(link.b))) - d.col(link.a);
    const Vec3 on_a = force(link, way, &on_b);
    sum += link.b < 0 ? 0.5 * on_a.dot(way) : 0.25 * (on_a - on_b).dot(way);
  }
  return sum;
}

void Umbrella::bend(const Points& d, Eigen::VectorXd* bends) const {
  Points sum = Points::Zero(3, d.cols());
  for (const Link& link : links_) {
    const Vec3 way = (link.b < 0 ? Vec3::Zero() : Vec3(d.col(link.b))) - d.col(link.a);
    sum.col(link.a) += way;
    if (link.b >= 0) sum.col(link.b) -= way;
  }
  // 3 h^2 L of neighbours at one distance.
  *bends = (6.0 * sum.colwise().norm().transpose()).cwiseQuotient(counts_);
}

Eigen::VectorXd Umbrella::longestSteps(const Eigen::VectorXd& masses,
                                       const Eigen::VectorXd& beside) const {
  Eigen::VectorXd sums = beside;
  for (const Link& link : links_) {
    const double most = std::max(link.across, link.along);
    sums[link.a] += (link.b < 0 ? 1.0 : 2.0) * most;
    if (link.b >= 0) sums[link.b] += 2.0 * most * link.of_b;
  }
  return 2.0 * masses.cwiseQuotient(sums).cwiseSqrt();
}

double Umbrella::publishedStep(double h) const { return h / wave_speed_; }

}  // namespace palpate::tissue
