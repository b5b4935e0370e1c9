// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <string>
#include <vector>

#include "palpate/material/material.h"
#include "palpate/mesh/cell_mesh.h"

namespace palpate::torture {

/// Forces on the nodes of tetrahedra by the formulas of docs/theory.md, Elements, one element after
/// the other and without what makes the core fast, to look from outside whether a solver told the
/// truth.
class TextbookSolid {
 public:
  /// `rest`: linear or quadratic tetrahedra, of which `rest.solid` says of which law each is.
  /// `element`: a name of fem::elementNames(). `frame`: from the material's axes to the world's.
  TextbookSolid(const mesh::CellMesh& rest, const std::string& element,
                const std::vector<material::Material>& laws, double density, const Mat3& frame);

  /// Elastic forces -dW/dx, 3 x n [N].
  Points elasticForces(const Points& now) const;
  /// Lumped, n [kg].
  const Eigen::VectorXd& masses() const { return masses_; }
  /// What gravity acts on, n [kg]: of quadratic tetrahedra not their masses.
  const Eigen::VectorXd& loaded() const { return loaded_; }

 private:
  struct Point {
    Eigen::Vector4d w;         // barycentric
    Eigen::MatrixXd gradient;  // of the nodes' shape functions at rest, nodes x 3 [1/m]
    double volume;             // it stands for [m^3]
  };
  struct Moduli {
    double mu, kappa, of_element;  // the last is what of kappa the element keeps to itself [Pa]
  };

  void addElement(Eigen::Index e, double density);
  void makePressures();
  const material::Material& lawOf(Eigen::Index e) const;
  std::size_t solidOf(Eigen::Index e) const;
  Mat3 deformation(const Point& point, Eigen::Index e, const Points& now) const;
  Eigen::VectorXd pressures(const Points& now) const;

  mesh::CellMesh rest_;
  std::string element_;
  std::vector<material::Material> laws_;
  Mat3 frame_;
  std::vector<Moduli> moduli_;  // of each law
  std::vector<std::vector<Point>> points_;
  Eigen::VectorXd masses_, loaded_;
  Eigen::Matrix4Xi pressure_;     // number of each corner's, or empty
  Eigen::VectorXd over_volumes_;  // kappa_n / V_n of averaged pressures
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> compliance_;  // of stabilised ones
};

}  // namespace palpate::torture
