// SPDX-License-Identifier: GPL-3.0-or-later
#include "linear_part.h"

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/fem/block_matrix.h"
#include "tissue/models/tensor_mass/tensors.h"

namespace palpate::tissue {
namespace {

// Right sides that are solved for at once.
constexpr Eigen::Index kColumns = 48;

Eigen::Index size(const std::vector<int>& nodes) {
  return 3 * static_cast<Eigen::Index>(nodes.size());
}

Eigen::VectorXd gather(const Eigen::VectorXd& all, const std::vector<int>& nodes) {
  Eigen::VectorXd part(size(nodes));
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    part.segment<3>(3 * static_cast<Eigen::Index>(k)) = all.segment<3>(3 * nodes[k]);
  }
  return part;
}

void add(const Eigen::VectorXd& part, const std::vector<int>& nodes, Points* all) {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    all->col(nodes[k]) += part.segment<3>(3 * static_cast<Eigen::Index>(k));
  }
}

}  // namespace

LinearPart::LinearPart(const mesh::TetMesh& mesh, const fem::Composition& composition,
                       const std::vector<int>& tets, const Eigen::VectorXd& volumes,
                       const fem::FreeMask& free, const Load& load)
    : X_(mesh.points), weights_(Points::Zero(3, mesh.numPoints())) {
  choose(mesh, tets, free, load.acted);
  inner_weight_ = gather(load.weights, inner_);
  u_i_ = permuted_ = inner_weight_;
  u_o_.setZero(size(outer_));
  u_p_.setZero(size(surface_));
  e_ = u_p_;
  u_c_.setZero(size(kept_));
  assemble(mesh, composition, tets, volumes);
  eliminateSurface(S_, load.weights);
}

void LinearPart::choose(const mesh::TetMesh& mesh, const std::vector<int>& tets,
                        const fem::FreeMask& free, const std::vector<char>& acted) {
  enum : char { kElsewhere, kInner, kSurface, kKept, kFixed };
  std::vector<char> kinds(static_cast<std::size_t>(mesh.numPoints()), kElsewhere);
  const auto atLeast = [&](int i, char kind) {
    char& now = kinds[static_cast<std::size_t>(i)];
    if (now != kElsewhere && now != kFixed) now = std::max(now, kind);
  };
  for (const int t : tets) {
    for (int k = 0; k < 4; ++k) {
      const int i = mesh.tets(k, t);
      const bool keeps = acted[static_cast<std::size_t>(i)] != 0;
      kinds[static_cast<std::size_t>(i)] = keeps                     ? kKept
                                           : free.col(i).isOnes(0.0) ? kInner
                                           : free.col(i).isZero(0.0) ? kFixed
                                                                     : kKept;
    }
  }
  const Eigen::MatrixXi faces = mesh::boundaryFaces(mesh);
  std::for_each(faces.data(), faces.data() + faces.size(), [&](int i) { atLeast(i, kSurface); });
  for (int t = 0; t < static_cast<int>(mesh.numTets()); ++t) {
    if (std::binary_search(tets.begin(), tets.end(), t)) continue;
    for (int k = 0; k < 4; ++k) atLeast(mesh.tets(k, t), kKept);
  }
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const int node = static_cast<int>(i);
    if (kinds[i] == kInner) inner_.push_back(node);
    if (kinds[i] == kSurface) surface_.push_back(node);
    if (kinds[i] == kKept) kept_.push_back(node);
    if (kinds[i] == kFixed) fixed_.push_back(node);
  }
  outer_ = kept_;
  outer_.insert(outer_.end(), surface_.begin(), surface_.end());
  if (outer_.size() > kMaxCondensedPoints) {
    throw std::invalid_argument(
        "the linear part has " + std::to_string(outer_.size()) +
        " points that are not held on its surface and the region's border: model hybrid keeps a "
        "dense matrix of at most " +
        std::to_string(kMaxCondensedPoints) +
        " (162 MB); enlarge edge_length or hybrid.region, or choose model tensor_mass");
  }
}

void LinearPart::assemble(const mesh::TetMesh& mesh, const fem::Composition& composition,
                          const std::vector<int>& tets, const Eigen::VectorXd& volumes) {
  std::vector<std::pair<int, int>> pairs;
  for (const int t : tets) {
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) pairs.emplace_back(mesh.tets(a, t), mesh.tets(b, t));
    }
  }
  fem::BlockMatrix K(static_cast<int>(mesh.numPoints()), pairs);
  for (const int t : tets) addTensors(mesh, t, volumes[t], composition.solid(t), &K);
  const auto part = [&](const std::vector<int>& rows, const std::vector<int>& columns) {
    std::vector<int> place(static_cast<std::size_t>(mesh.numPoints()), -1);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      place[static_cast<std::size_t>(columns[k])] = static_cast<int>(k);
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t a = 0; a < rows.size(); ++a) {
      for (int slot = K.rowBegin(rows[a]); slot < K.rowEnd(rows[a]); ++slot) {
        const int b = place[static_cast<std::size_t>(K.column(slot))];
        if (b < 0) continue;
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c) {
            entries.emplace_back(3 * static_cast<int>(a) + r, 3 * b + c, K.block(slot)(r, c));
          }
        }
      }
    }
    Sparse matrix(size(rows), size(columns));
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  };
  K_io_ = part(inner_, outer_);
  K_fo_ = part(fixed_, outer_);
  K_fi_ = part(fixed_, inner_);
  if (!inner_.empty()) {
    factor_.compute(part(inner_, inner_));
    if (factor_.info() != Eigen::Success) {
      throw std::invalid_argument("the linear part's stiffness is not positive definite");
    }
  }
  S_ = withoutInner(part(outer_, outer_));
}

Eigen::MatrixXd LinearPart::withoutInner(const Sparse& K_oo) {
  Eigen::MatrixXd S = K_oo;
  if (inner_.empty()) return S;
  const Sparse K_oi = K_io_.transpose();
  for (Eigen::Index begin = 0; begin < S.cols(); begin += kColumns) {
    const Eigen::Index count = std::min(kColumns, S.cols() - begin);
    const Eigen::MatrixXd right = K_io_.middleCols(begin, count);
    S.middleCols(begin, count) -= K_oi * Eigen::MatrixXd(factor_.solve(right));
  }
  return 0.5 * (S + S.transpose());
}

void LinearPart::eliminateSurface(const Eigen::MatrixXd& S_oo, const Eigen::VectorXd& weights) {
  const Eigen::Index c = size(kept_), p = size(surface_);
  Eigen::VectorXd passed_on = Eigen::VectorXd::Zero(size(outer_));
  if (!inner_.empty()) {
    solveInner(&u_i_);
    passed_on = K_io_.transpose() * u_i_;
    energy_of_weights_ += 0.5 * u_i_.dot(inner_weight_);
  }
  const Eigen::VectorXd of_surface = gather(weights, surface_);
  const Eigen::LLT<Eigen::MatrixXd> factor(S_oo.bottomRightCorner(p, p));
  if (factor.info() != Eigen::Success) {
    throw std::invalid_argument("the linear part is held by nothing; enlarge hybrid.region");
  }
  C_ = Eigen::MatrixXd::Identity(p, p);
  T_ = -S_oo.bottomLeftCorner(p, c);
  if (C_.size() > 0) factor.solveInPlace(C_);
  if (T_.size() > 0) factor.solveInPlace(T_);  // without columns it would read from nowhere
  const Eigen::VectorXd left = of_surface - passed_on.tail(p);
  a_ = C_ * left;
  energy_of_weights_ += 0.5 * a_.dot(left);
  add(passed_on.head(c) + S_oo.topRightCorner(c, p) * a_, kept_, &weights_);
  add(of_surface, surface_, &weights_);
  add(inner_weight_, inner_, &weights_);
  Eigen::MatrixXd S = S_oo.topLeftCorner(c, c) + S_oo.topRightCorner(c, p) * T_;
  S_ = 0.5 * (S + S.transpose());
}

// Without memory of its own, as cycles need it.
void LinearPart::solveInner(Eigen::VectorXd* b) {
  permuted_.noalias() = factor_.permutationP() * *b;
  factor_.matrixL().solveInPlace(permuted_);
  factor_.matrixU().solveInPlace(permuted_);
  b->noalias() = factor_.permutationPinv() * permuted_;
}

void LinearPart::keptOf(const Points& x, Eigen::VectorXd* u_c) const {
  u_c->resize(size(kept_));
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    u_c->segment<3>(3 * static_cast<Eigen::Index>(k)) = x.col(kept_[k]) - X_.col(kept_[k]);
  }
}

void LinearPart::recover(const Eigen::VectorXd& u_c, const std::vector<int>& touched,
                         const Eigen::Ref<const Eigen::VectorXd>& e, Points* x) {
  const bool known = answered_ && u_c == u_c_ && touched == touched_ && e == e_.head(e.size());
  if (!known) answer(u_c, touched, e);
  for (std::size_t k = 0; k < surface_.size(); ++k) {
    x->col(surface_[k]) = X_.col(surface_[k]) + u_p_.segment<3>(3 * static_cast<Eigen::Index>(k));
  }
  for (std::size_t k = 0; k < inner_.size(); ++k) {
    x->col(inner_[k]) = X_.col(inner_[k]) + u_i_.segment<3>(3 * static_cast<Eigen::Index>(k));
  }
}

void LinearPart::answer(const Eigen::VectorXd& u_c, const std::vector<int>& touched,
                        const Eigen::Ref<const Eigen::VectorXd>& e) {
  answered_ = true;
  u_c_ = u_c;
  touched_ = touched;
  e_.head(e.size()) = e;
  u_p_ = a_;
  u_p_.noalias() += T_ * u_c;
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const Vec3 force = e.segment<3>(3 * static_cast<Eigen::Index>(k));
    if (!force.isZero(0.0)) u_p_.noalias() += C_.middleCols<3>(3 * touched[k]) * force;
  }
  if (inner_.empty()) return;
  u_o_ << u_c, u_p_;
  u_i_ = inner_weight_;
  u_i_.noalias() -= K_io_ * u_o_;
  solveInner(&u_i_);
}

// Of fixed points, whose displacements are zero.
void LinearPart::reactions(Points* g) {
  g->resize(3, size(fixed_) / 3);
  Eigen::Map<Eigen::VectorXd> f(g->data(), g->size());
  u_o_ << u_c_, u_p_;
  f.noalias() = K_fo_ * u_o_;
  f.noalias() += K_fi_ * u_i_;
}

}  // namespace palpate::tissue
