// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/mesh_change.h"

namespace palpate::mesh {

Eigen::MatrixXd MeshChange::interpolate(const Eigen::MatrixXd& old) const {
  Eigen::MatrixXd field(old.rows(), numNewPoints());
  for (int i = 0; i < numNewPoints(); ++i) {
    if (old_point[i] >= 0) field.col(i) = old.col(old_point[i]);
  }
  for (const Middle& m : added) field.col(m.point) = 0.5 * (field.col(m.a) + field.col(m.b));
  return field;
}

Eigen::MatrixXd MeshChange::transport(const Eigen::MatrixXd& old, const Eigen::VectorXd& old_masses,
                                      const Eigen::VectorXd& new_masses) const {
  Eigen::MatrixXd field = interpolate(old);
  if (removed.empty()) return field;
  // The new field at the old points that are no more, coarse ones first, ...
  Eigen::MatrixXd there = old;
  for (auto m = removed.rbegin(); m != removed.rend(); ++m) {
    there.col(m->point) = 0.5 * (there.col(m->a) + there.col(m->b));
  }
  // ... and what is lost there, handed on to the points around, fine ones first.
  Eigen::MatrixXd lost = Eigen::MatrixXd::Zero(old.rows(), old.cols());
  for (const Middle& m : removed) {
    const Eigen::VectorXd amount =
        lost.col(m.point) + old_masses[m.point] * (old.col(m.point) - there.col(m.point));
    lost.col(m.a) += 0.5 * amount;
    lost.col(m.b) += 0.5 * amount;
    lost.col(m.point).setZero();
  }
  for (int i = 0; i < numNewPoints(); ++i) {
    if (old_point[i] >= 0) field.col(i) += lost.col(old_point[i]) / new_masses[i];
  }
  return field;
}

}  // namespace palpate::mesh
