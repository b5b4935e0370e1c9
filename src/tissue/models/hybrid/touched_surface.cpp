// SPDX-License-Identifier: GPL-3.0-or-later
#include "touched_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

using Square = Eigen::Map<Eigen::MatrixXd>;

// Of memory that is only ever enlarged.
Square mapOf(std::vector<double>* memory, Eigen::Index rows, Eigen::Index columns) {
  const std::size_t needed = static_cast<std::size_t>(rows * columns);
  if (memory->size() < needed) memory->resize(needed);
  return Square(memory->data(), rows, columns);
}

Eigen::Index rowOf(int place) { return 3 * static_cast<Eigen::Index>(place); }

}  // namespace

TouchedSurface::TouchedSurface(const LinearPart* part) : part_(*part) {
  const std::vector<int>& surface = part->surface();
  pins_.reserve(surface.size());
  for (std::size_t k = 0; k < surface.size(); ++k) {
    const std::size_t node = static_cast<std::size_t>(surface[k]);
    if (place_of_.size() <= node) place_of_.resize(node + 1, -1);
    place_of_[node] = static_cast<int>(k);
    const Eigen::Index at = rowOf(static_cast<int>(k));
    pins_.emplace_back(part->compliance().block<3, 3>(at, at).inverse());
  }
  pinned_.setZero(3, static_cast<Eigen::Index>(surface.size()));
  touched_.assign(surface.size(), 0);
  on_kept_.setZero(part->stiffness().rows());
  r_.setZero(part->underWeights().size());
  e_.setZero(part->underWeights().size());
  nodes_.setZero((r_.size() + on_kept_.size()) / 3);
}

bool TouchedSurface::set(const std::vector<int>& nodes) {
  next_.clear();
  for (const int i : nodes) {
    if (i >= static_cast<int>(place_of_.size())) continue;
    if (place_of_[static_cast<std::size_t>(i)] >= 0) {
      next_.push_back(place_of_[static_cast<std::size_t>(i)]);
    }
  }
  if (next_ == places_) return false;
  for (const int k : places_) touched_[static_cast<std::size_t>(k)] = 0;
  places_ = next_;
  for (const int k : places_) touched_[static_cast<std::size_t>(k)] = 1;
  size_ = rowOf(static_cast<int>(places_.size()));
  invert();
  multiplyOut();
  return true;
}

void TouchedSurface::pin(const Points& x) {
  const std::vector<int>& surface = part_.surface();
  for (std::size_t k = 0; k < surface.size(); ++k) {
    pinned_.col(static_cast<Eigen::Index>(k)) = x.col(surface[k]);
  }
}

// Q from C_AA, by Gauss and Jordan in place: it is positive definite.
void TouchedSurface::invert() {
  Square Q = mapOf(&Q_memory_, size_, size_);
  for (std::size_t a = 0; a < places_.size(); ++a) {
    for (std::size_t b = 0; b < places_.size(); ++b) {
      Q.block<3, 3>(rowOf(static_cast<int>(a)), rowOf(static_cast<int>(b))) =
          part_.compliance().block<3, 3>(rowOf(places_[a]), rowOf(places_[b]));
    }
  }
  for (Eigen::Index k = 0; k < size_; ++k) {
    const double pivot = 1.0 / Q(k, k);
    Q(k, k) = 1.0;
    Q.col(k) *= pivot;
    for (Eigen::Index j = 0; j < size_; ++j) {
      if (j == k) continue;
      const double factor = Q(k, j);
      Q(k, j) = 0.0;
      Q.col(j) -= factor * Q.col(k);
    }
  }
}

// Over A and the kept points: [Q - D, -Q T; -T^T Q, T^T Q T].
void TouchedSurface::multiplyOut() {
  const std::vector<int>& kept = part_.kept();
  const Eigen::Index c = part_.stiffness().rows(), all = size_ + c;
  for (std::size_t a = 0; a < places_.size(); ++a) {
    nodes_[static_cast<Eigen::Index>(a)] = part_.surface()[static_cast<std::size_t>(places_[a])];
  }
  for (std::size_t k = 0; k < kept.size(); ++k) {
    nodes_[size_ / 3 + static_cast<Eigen::Index>(k)] = kept[k];
  }
  if (size_ == 0) return;
  const Square Q = mapOf(&Q_memory_, size_, size_);
  Square T = mapOf(&T_memory_, size_, c), H = mapOf(&H_memory_, all, all);
  for (std::size_t a = 0; a < places_.size(); ++a) {
    T.middleRows<3>(rowOf(static_cast<int>(a))) = part_.transfer().middleRows<3>(rowOf(places_[a]));
  }
  H.topLeftCorner(size_, size_) = Q;
  for (std::size_t a = 0; a < places_.size(); ++a) {
    const Eigen::Index at = rowOf(static_cast<int>(a));
    H.block<3, 3>(at, at) -= pins_[static_cast<std::size_t>(places_[a])];
  }
  for (Eigen::Index k = 0; k < c; ++k) {
    H.col(size_ + k).head(size_).noalias() = -Q * T.col(k);
    H.row(size_ + k).head(size_) = H.col(size_ + k).head(size_).transpose();
  }
  for (Eigen::Index k = 0; k < c; ++k) {
    H.col(size_ + k).tail(c).noalias() = -T.transpose() * H.col(size_ + k).head(size_);
  }
}

Eigen::Ref<const Eigen::VectorXd> TouchedSurface::forces(const Points& x,
                                                         const Eigen::VectorXd& u_c) {
  for (std::size_t a = 0; a < places_.size(); ++a) {
    const Eigen::Index at = rowOf(places_[a]);
    const int node = nodes_[static_cast<Eigen::Index>(a)];
    r_.segment<3>(rowOf(static_cast<int>(a))) =
        x.col(node) - part_.rest(node) - part_.underWeights().segment<3>(at);
  }
  if (size_ == 0) return e_.head(0);
  r_.head(size_).noalias() -= mapOf(&T_memory_, size_, part_.stiffness().rows()) * u_c;
  e_.head(size_).noalias() = mapOf(&Q_memory_, size_, size_) * r_.head(size_);
  return e_.head(size_);
}

double TouchedSurface::addGradient(const Points& x, const Eigen::VectorXd& u_c, bool back,
                                   Points* g) {
  double energy = 0.0;
  const std::vector<int>& surface = part_.surface();
  for (std::size_t k = 0; k < surface.size(); ++k) {
    if (touched_[k]) continue;
    const Vec3 way = x.col(surface[k]) - pinned_.col(static_cast<Eigen::Index>(k));
    const Vec3 force = pins_[k] * way;
    g->col(surface[k]) += force;
    energy += 0.5 * way.dot(force);
  }
  if (size_ == 0) return energy;
  forces(x, u_c);
  energy += 0.5 * r_.head(size_).dot(e_.head(size_));
  for (std::size_t a = 0; a < places_.size(); ++a) {
    g->col(nodes_[static_cast<Eigen::Index>(a)]) += e_.segment<3>(rowOf(static_cast<int>(a)));
  }
  if (!back) return energy;
  on_kept_.noalias() = mapOf(&T_memory_, size_, on_kept_.size()).transpose() * e_.head(size_);
  for (std::size_t k = 0; k < part_.kept().size(); ++k) {
    g->col(part_.kept()[k]) -= on_kept_.segment<3>(rowOf(static_cast<int>(k)));
  }
  return energy;
}

void TouchedSurface::addPins(fem::BlockMatrix* K) const {
  for (std::size_t k = 0; k < pins_.size(); ++k) {
    K->block(K->diagonal(part_.surface()[k])) += pins_[k];
  }
}

void TouchedSurface::addHessian(bool back, fem::Stiffness* K) const {
  if (size_ == 0) return;
  const Eigen::Index all = size_ + on_kept_.size(), used = back ? all : size_;
  const Eigen::Map<const Eigen::MatrixXd> H(H_memory_.data(), all, all);
  K->add(nodes_.head(used / 3), H.topLeftCorner(used, used));
}

}  // namespace palpate::tissue
