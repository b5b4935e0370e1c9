// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/network_modes.h"

#include <Eigen/Dense>

#include "palpate/springs/network_statics.h"

namespace palpate::springs {

NetworkModes networkModes(const SpringNetwork& network) {
  const Eigen::MatrixXd K = networkTangent(network, network.points);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
  const double small = 1e-9 * values.cwiseAbs().maxCoeff();
  const auto falling = static_cast<int>((values.array() < -small).count());
  return {falling, static_cast<int>((values.array() <= small).count()) - falling};
}

}  // namespace palpate::springs
