// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "palpate/tissue/interaction.h"
#include "palpate/tissue/model_settings.h"

namespace palpate::test {

struct RepulsionSettings {
  double reach = 0.006;        ///< [m]
  double stiffness = 400.0;    ///< [N/m]
  double bond = 0.0;           ///< Of what two nodes that were near remember [N/m].
  double least_at_rest = 0.0;  ///< Nodes nearer than that at rest do not act on each other [m].
};

/// Nodes of two surfaces nearer than `reach` push each other apart, with the energy
/// stiffness (reach - r)^3 / (3 reach) of a pair at distance r; within a body likewise. With `bond`
/// those that were near when a step ended are held to each other as they were then, until they are
/// `reach` apart: a memory, as small as can be.
class RepulsionTerm final : public tissue::InteractionTerm {
 public:
  RepulsionTerm(const tissue::InteractingBody& a, const tissue::InteractingBody& b,
                const RepulsionSettings& settings)
      : s_(settings), self_(&a == &b), split_(static_cast<int>(a.X.cols())) {
    for (const int i :
         std::set<int>(a.triangles.reshaped().begin(), a.triangles.reshaped().end())) {
      first_.push_back(i);
    }
    for (const int i :
         std::set<int>(b.triangles.reshaped().begin(), b.triangles.reshaped().end())) {
      second_.push_back(self_ ? i : split_ + i);
    }
    X_.resize(3, a.X.cols() + (self_ ? 0 : b.X.cols()));
    X_.leftCols(a.X.cols()) = a.X;
    if (!self_) X_.rightCols(b.X.cols()) = b.X;
  }

  void search(const Points& x, double way) override {
    const double far = s_.reach + 2.0 * way;
    near_.clear();
    searched_at_ = x;
    way_ = way;
    const auto size = static_cast<Eigen::Index>(second_.size());
    Vec3 low = x.col(second_.front()), high = low;
    for (Eigen::Index k = 1; k < size; ++k) {
      low = low.cwiseMin(x.col(second_[static_cast<std::size_t>(k)]));
      high = high.cwiseMax(x.col(second_[static_cast<std::size_t>(k)]));
    }
    for (const int i : first_) {
      const Vec3 p = x.col(i);
      if ((p.array() < low.array() - far).any() || (p.array() > high.array() + far).any()) continue;
      for (const int j : second_) {
        if (self_ && j <= i) continue;
        if ((x.col(j) - p).squaredNorm() > far * far) continue;
        if ((X_.col(j) - X_.col(i)).norm() < s_.least_at_rest) continue;
        near_.emplace_back(i, j);
      }
    }
  }
  bool holds(const Points& x) const override {
    return (x - searched_at_).colwise().norm().maxCoeff() <= way_;
  }

  double value(const Points& x) const override {
    double sum = 0.0;
    for (const auto& [i, j] : near_) {
      const Vec3 way = x.col(j) - x.col(i);
      const double less = s_.reach - way.norm();
      if (less > 0.0) sum += s_.stiffness * less * less * less / (3.0 * s_.reach);
      if (const Vec3* held = bond(i, j)) sum += 0.5 * s_.bond * (way - *held).squaredNorm();
    }
    return sum;
  }
  double addGradient(const Points& x, Points* g) const override {
    for (const auto& [i, j] : near_) {
      const Vec3 way = x.col(j) - x.col(i);
      const double r = way.norm(), less = s_.reach - r;
      Vec3 f = Vec3::Zero();  // dE / d way
      if (less > 0.0) f = -s_.stiffness * less * less / (s_.reach * r) * way;
      if (const Vec3* held = bond(i, j)) f += s_.bond * (way - *held);
      g->col(j) += f;
      g->col(i) -= f;
    }
    return value(x);
  }
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override {
    for (const auto& [i, j] : near_) {
      const Vec3 way = x.col(j) - x.col(i);
      const double r = way.norm(), less = s_.reach - r;
      const Vec3* held = bond(i, j);
      if (less <= 0.0 && !held) continue;
      Mat3 H = Mat3::Zero();
      if (less > 0.0) {
        const Vec3 n = way / r;
        H = 2.0 * s_.stiffness * less / s_.reach * n * n.transpose();
        if (tangent == fem::Tangent::kExact) {
          H -= s_.stiffness * less * less / (s_.reach * r) * (Mat3::Identity() - n * n.transpose());
        }
      }
      if (held) H += s_.bond * Mat3::Identity();
      K->add(i, i, H);
      K->add(j, j, H);
      K->add(i, j, -H);
      K->add(j, i, -H);
    }
  }

  void endStep(const Points& x) override {
    if (s_.bond == 0.0) return;
    std::map<std::pair<int, int>, Vec3> bonds;
    for (const auto& [i, j] : near_) {
      const Vec3 way = x.col(j) - x.col(i);
      if (way.norm() > s_.reach) continue;
      const Vec3* held = bond(i, j);
      bonds[{i, j}] = held ? *held : way;
    }
    bonds_.swap(bonds);
  }
  void forget() override { bonds_.clear(); }
  void goOnFrom(const tissue::InteractionTerm& old) override {
    const auto& before = dynamic_cast<const RepulsionTerm&>(old);
    const auto now = [&](int i, const std::vector<int>& nodes) {
      for (const int k : nodes) {
        if ((X_.col(k) - before.X_.col(i)).norm() < 1e-9) return k;
      }
      return -1;
    };
    for (const auto& [pair, way] : before.bonds_) {
      const int i = now(pair.first, first_), j = now(pair.second, second_);
      if (i >= 0 && j >= 0) bonds_[{i, j}] = way;
    }
  }
  void save(StateWriter* to) const override {
    to->put(static_cast<std::int64_t>(bonds_.size()));
    for (const auto& [pair, way] : bonds_) {
      to->put(pair.first);
      to->put(pair.second);
      to->put(way);
    }
  }
  void restore(StateReader* from) override {
    bonds_.clear();
    for (std::int64_t left = from->count(2 * sizeof(int)); left > 0; --left) {
      std::pair<int, int> pair;
      from->get(&pair.first);
      from->get(&pair.second);
      from->get(&bonds_[pair]);
    }
  }

 private:
  const Vec3* bond(int i, int j) const {
    const auto found = bonds_.find({i, j});
    return found == bonds_.end() ? nullptr : &found->second;
  }

  RepulsionSettings s_;
  bool self_;
  int split_;
  std::vector<int> first_, second_;  // nodes of the surfaces
  Points X_, searched_at_;
  double way_ = 0.0;
  std::vector<std::pair<int, int>> near_;
  std::map<std::pair<int, int>, Vec3> bonds_;
};

class Repulsion final : public tissue::Interaction {
 public:
  explicit Repulsion(const RepulsionSettings& settings) : settings_(settings) {}
  /// Within a body it acts where `least_at_rest` says how.
  bool possible(const tissue::InteractingBody& a, const tissue::InteractingBody& b) const override {
    if (&a == &b) return settings_.least_at_rest > 0.0;
    return tissue::boxesOverlap(a, b, settings_.reach);
  }
  std::unique_ptr<tissue::InteractionTerm> make(const tissue::InteractingBody& a,
                                                const tissue::InteractingBody& b) const override {
    return std::make_unique<RepulsionTerm>(a, b, settings_);
  }

 private:
  RepulsionSettings settings_;
};

/// For ModelSettings::interactions.
template <int bond>
tissue::InteractionEntry repulsion() {
  return {"repulsion", [](const tissue::ModelSettings&) {
            RepulsionSettings settings;
            settings.bond = bond;
            return std::shared_ptr<const tissue::Interaction>(new Repulsion(settings));
          }};
}

}  // namespace palpate::test
