// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/fem/elasticity.h"
#include "palpate/fem/supports.h"
#include "palpate/solver/stiffness_factor.h"
#include "tissue/body/body_surroundings.h"
#include "tissue/touch/compliant_contact.h"

namespace palpate::tissue {

constexpr int kMaxComplianceNodes = 2000;

/// Linear elastostatics about the rest configuration, condensed onto the surface [Bro-Nielsen,
/// Cotin 1996]: rows and columns of K^-1 of surface nodes [Green's functions: James, Pai 1999].
class SurfaceCompliance {
 public:
  /// `X`: rest positions, 3 x n [m]; `triangles`: surface; `surroundings`: boundary conditions with
  /// springs; null: none.
  /// @throws std::invalid_argument if the supports do not hold the body or the surface has more
  /// than kMaxComplianceNodes nodes that can move.
  SurfaceCompliance(fem::Elasticity* elasticity, const fem::FreeMask& free, const Points& X,
                    const Eigen::Matrix3Xi& triangles,
                    const BodySurroundings* surroundings = nullptr);

  /// Solves for displacements u [m] under nodal forces f [N], both 3 x n.
  void solve(const Points& f, Points* u) const;
  /// Computes forces f [N] of displacements u [m], 3 x n; at held components support forces.
  void multiply(const Points& u, Points* f) const { stiffness_.multiply(u, f); }

  /// Compliance of the free surface nodes.
  NodeCompliance ofNodes() const { return {position_, matrix_}; }
  /// Index of a node among the free surface nodes, or -1.
  int find(int node) const { return position_[node]; }
  /// Size of the compliance matrix [bytes].
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
