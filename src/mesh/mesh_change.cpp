// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/mesh_change.h"

namespace palpate::mesh {

Eigen::MatrixXd MeshChange::interpolate(const Eigen::MatrixXd& old) const {
  Eigen::MatrixXd field(old.rows(), numNewPoints());
  for (int i = 0; i < numNewPoints(); ++i) {
    if (old_point[i] >= 0) field.col(i) = old.col(old_point[i]);
  }
  for (const Middle& m : added) field.col(m.point) = 0.5 * (field.col(m.a) + field.col(m.b));
  for (const Inside& at : inside) {
    field.col(at.point) = at.values[0] * old.col(at.nodes[0]);
    for (int k = 1; k < 10; ++k) field.col(at.point) += at.values[k] * old.col(at.nodes[k]);
  }
  return field;
}

Eigen::MatrixXd MeshChange::transport(const Eigen::MatrixXd& old, const LumpedMasses& old_masses,
                                      const LumpedMasses& new_masses) const {
  Eigen::MatrixXd field = interpolate(old);
  if (quadratic()) keepAmount(old, old_masses, new_masses, &field);
  if (removed.empty()) return field;
  // New field at the removed points, coarse ones first.
  Eigen::MatrixXd there = old;
  for (auto m = removed.rbegin(); m != removed.rend(); ++m) {
    there.col(m->point) = 0.5 * (there.col(m->a) + there.col(m->b));
  }
  // Loss at the removed points, distributed to the adjacent ones, fine ones first.
  Eigen::MatrixXd lost = Eigen::MatrixXd::Zero(old.rows(), old.cols());
  for (const Middle& m : removed) {
    const Eigen::VectorXd amount =
        lost.col(m.point) + old_masses.points[m.point] * (old.col(m.point) - there.col(m.point));
    lost.col(m.a) += 0.5 * amount;
    lost.col(m.b) += 0.5 * amount;
    lost.col(m.point).setZero();
  }
  for (int i = 0; i < numNewPoints(); ++i) {
    if (old_point[i] >= 0) field.col(i) += lost.col(old_point[i]) / new_masses.points[i];
  }
  return field;
}

void MeshChange::keepAmount(const Eigen::MatrixXd& old, const LumpedMasses& old_masses,
                            const LumpedMasses& new_masses, Eigen::MatrixXd* field) const {
  const Eigen::MatrixXd& carried = *field;
  const auto amount = [](const Eigen::MatrixXd& values, const auto& nodes,
                         const Eigen::MatrixXd& shares, int tet) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.rows());
    for (int k = 0; k < 10; ++k) sum += shares(k, tet) * values.col(nodes(k, tet));
    return sum;
  };
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(old.rows(), numNewPoints());
  const int num_tets = static_cast<int>(tets.size());
  // Patches of equal material points: new tetrahedra begin .. end - 1, old ones first .. last - 1.
  for (int begin = 0, end = 0; begin < num_tets; begin = end) {
    const auto [first, last] = tets[begin];
    while (end < num_tets && tets[end].first == first) ++end;
    if (end - begin == 1 && last - first == 1) continue;
    Eigen::VectorXd lost = Eigen::VectorXd::Zero(old.rows());
    double mass = 0.0;
    for (int t = first; t < last; ++t) lost += amount(old, old_nodes, old_masses.shares, t);
    for (int t = begin; t < end; ++t) {
      lost -= amount(carried, new_nodes, new_masses.shares, t);
      mass += new_masses.shares.col(t).sum();
    }
    for (int t = begin; t < end; ++t) {
      for (int k = 0; k < 10; ++k) {
        change.col(new_nodes(k, t)) += new_masses.shares(k, t) / mass * lost;
      }
    }
  }
  for (int i = 0; i < numNewPoints(); ++i) field->col(i) += change.col(i) / new_masses.points[i];
}

}  // namespace palpate::mesh
