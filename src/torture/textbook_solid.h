// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <string>
#include <vector>

#include "palpate/material/material.h"
#include "palpate/mesh/cell_mesh.h"

namespace palpate::torture {

/// Nodal forces of tetrahedra by the formulas of docs/theory.md, Elements: serial and unoptimised,
/// for an independent check of solvers.
class TextbookSolid {
 public:
  /// `rest`: linear or quadratic tetrahedra; `rest.solid` is the index of each one's law.
  /// `element`: a name of fem::elementNames(). `frame`: from the material's axes to the world's.
  TextbookSolid(const mesh::CellMesh& rest, const std::string& element,
                const std::vector<material::Material>& laws, double density, const Mat3& frame);

  /// Elastic forces -dW/dx, 3 x n [N].
  Points elasticForces(const Points& now) const;
  /// Lumped masses, n [kg].
  const Eigen::VectorXd& masses() const { return masses_; }
  /// Masses for gravity, n [kg]; they differ from masses() for quadratic tetrahedra.
  const Eigen::VectorXd& loaded() const { return loaded_; }

 private:
  struct Point {
    Eigen::Vector4d w;         // barycentric
    Eigen::MatrixXd gradient;  // of shape functions at rest, nodes x 3 [1/m]
    double volume;             // weight of the point [m^3]
  };
  struct Moduli {
    double mu, kappa, of_element;  // of_element: the element's own part of kappa [Pa]
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
  Eigen::Matrix4Xi pressure_;     // index for each corner; may be empty
  Eigen::VectorXd over_volumes_;  // kappa_n / V_n for averaged pressures
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> compliance_;  // for stabilised pressures
};

}  // namespace palpate::torture
