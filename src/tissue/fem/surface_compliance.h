// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "body_surroundings.h"
#include "palpate/fem/elasticity.h"
#include "palpate/fem/supports.h"
#include "palpate/solver/stiffness_factor.h"
#include "tissue/touch/compliant_contact.h"

namespace palpate::tissue {

constexpr int kMaxComplianceNodes = 2000;

/// Linear elastostatics of a body about its rest with its supports, condensed onto its surface
/// [Bro-Nielsen, Cotin 1996]: the columns of K^-1 that belong to nodes which can be touched, of
/// which the rows of these nodes are kept [Green's functions: James, Pai 1999].
class SurfaceCompliance {
 public:
  /// `X`: rest, 3 x n [m]; `triangles`: the surface; `surroundings`: of the body, whose springs
  /// hold it, too; null: there are none.
  /// @throws std::invalid_argument if the supports do not hold the body or the surface has more
  /// than kMaxComplianceNodes nodes that can move.
  SurfaceCompliance(fem::Elasticity* elasticity, const fem::FreeMask& free, const Points& X,
                    const Eigen::Matrix3Xi& triangles,
                    const BodySurroundings* surroundings = nullptr);

  /// The displacements u of all nodes under the forces f, 3 x n, [m] and [N].
  void solve(const Points& f, Points* u) const;
  /// The forces of the displacements u, 3 x n; at held components too, where they are the
  /// support's.
  void multiply(const Points& u, Points* f) const { stiffness_.multiply(u, f); }

  /// Of the nodes that can be touched and move.
  NodeCompliance ofNodes() const { return {position_, matrix_}; }
  /// Position of a node among those that can be touched and move, or -1.
  int find(int node) const { return position_[node]; }
  /// [bytes]
  std::size_t memory() const { return sizeof(double) * static_cast<std::size_t>(matrix_.size()); }

 private:
  void condense(const fem::FreeMask& free);

  std::vector<int> nodes_, position_;
  fem::FreeMask free_;
  fem::Stiffness stiffness_;
  std::unique_ptr<solver::StiffnessFactor> factor_;
  Eigen::MatrixXd matrix_;
};

}  // namespace palpate::tissue
