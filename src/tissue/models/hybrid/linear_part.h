// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "palpate/fem/composition.h"
#include "palpate/fem/supports.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::tissue {

constexpr int kMaxCondensedPoints = 1500;

/// Precomputed linear elastostatics of tetrahedra, K u = f. Kinds of points:
///
///   `kept` c   shared with the region or loaded: unknowns,
///   `surface`  p, free, may be touched,
///   `inner`    i, free, feel nothing but their weight,
///   `fixed`    are held for ever.
///
/// Static condensation eliminates inner points [Guyan 1965; Bro-Nielsen, Cotin 1996], then the
/// surface, which leaves a compliance [James, Pai 1999]: under forces e on the surface,
///
///   u_p = a + T u_c + C e,   f_c = S u_c + b - T^T e.
class LinearPart {
 public:
  struct Load {
    Eigen::VectorXd
        weights;  ///< Weights of all points, 3 n [N]; used at free points that are not kept.
    std::vector<char> acted;  ///< n: whether other loads or prescribed motion act.
  };
  /// `tets`: of `mesh`, which is at rest in the world, ascending; `volumes` of all [m^3].
  /// @throws std::invalid_argument for more than kMaxCondensedPoints that are kept or surface.
  LinearPart(const mesh::TetMesh& mesh, const fem::Composition& composition,
             const std::vector<int>& tets, const Eigen::VectorXd& volumes,
             const fem::FreeMask& free, const Load& load);

  /// Ascending.
  const std::vector<int>& kept() const { return kept_; }
  const std::vector<int>& surface() const { return surface_; }
  const std::vector<int>& inner() const { return inner_; }
  const std::vector<int>& fixed() const { return fixed_; }

  const Eigen::MatrixXd& stiffness() const { return S_; }     ///< S [N/m]
  const Eigen::MatrixXd& transfer() const { return T_; }      ///< T
  const Eigen::MatrixXd& compliance() const { return C_; }    ///< C [m/N]
  const Eigen::VectorXd& underWeights() const { return a_; }  ///< a [m]
  /// Gradient of the elastic energy without S u_c and without touches: b at kept points, the
  /// weights at surface and inner ones, 3 x n [N].
  const Points& weights() const { return weights_; }
  /// The elastic energy where u_c and e are zero [J].
  double energyOfWeights() const { return energy_of_weights_; }

  /// Rest position of a point [m].
  auto rest(int node) const { return X_.col(node); }
  /// u_c of x, 3 x n [m].
  void keptOf(const Points& x, Eigen::VectorXd* u_c) const;
  /// Computes surface and inner points of x, in equilibrium under displacements u_c and forces e on
  /// surface points `touched`, indices in surface().
  void recover(const Eigen::VectorXd& u_c, const std::vector<int>& touched,
               const Eigen::Ref<const Eigen::VectorXd>& e, Points* x);
  /// The gradient of the elastic energy at fixed(), 3 x their number [N], after recover().
  void reactions(Points* g);
  /// Size of the dense matrices [bytes].
  std::size_t memory() const {
    return sizeof(double) * static_cast<std::size_t>(S_.size() + T_.size() + C_.size());
  }

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  void choose(const mesh::TetMesh& mesh, const std::vector<int>& tets, const fem::FreeMask& free,
              const std::vector<char>& acted);
  void assemble(const mesh::TetMesh& mesh, const fem::Composition& composition,
                const std::vector<int>& tets, const Eigen::VectorXd& volumes);
  Eigen::MatrixXd withoutInner(const Sparse& K_oo);
  void eliminateSurface(const Eigen::MatrixXd& S_oo, const Eigen::VectorXd& weights);
  void solveInner(Eigen::VectorXd* b);
  void answer(const Eigen::VectorXd& u_c, const std::vector<int>& touched,
              const Eigen::Ref<const Eigen::VectorXd>& e);

  std::vector<int> kept_, surface_, inner_, fixed_;
  std::vector<int> outer_;  // kept, then surface
  Points X_;
  Sparse K_io_, K_fo_, K_fi_;
  Eigen::SimplicialLLT<Sparse> factor_;  // of K_ii
  Eigen::MatrixXd S_, T_, C_;
  Eigen::VectorXd a_;
  Points weights_;
  double energy_of_weights_ = 0.0;
  Eigen::VectorXd inner_weight_, u_o_, u_p_, u_i_, permuted_;
  bool answered_ = false;
  std::vector<int> touched_;  // of the last recover(),
  Eigen::VectorXd u_c_, e_;   // likewise
};

}  // namespace palpate::tissue
