// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <stdexcept>

#include "palpate/fem/elasticity.h"

namespace palpate::tissue {

/// Base of elasticities other than finite elements: lumped masses, no viscous memory, a fixed mesh.
class UnchangingElasticity : public fem::Elasticity {
 public:
  int numNodes() const override { return static_cast<int>(masses_.size()); }
  bool viscous() const override { return false; }
  const Eigen::VectorXd& masses() const override { return masses_; }
  const Eigen::VectorXd& loadWeights() const override { return masses_; }
  void beginStep(double) override {}
  void endStep(const Points&) override {}
  void relax(const Points&) override {}
  std::unique_ptr<fem::ViscousState> saveViscousState() const override { return nullptr; }
  void restoreViscousState(const fem::ViscousState*) override {}
  /// @throws std::invalid_argument always: not supported.
  void goOnFrom(const fem::Elasticity&, const mesh::MeshChange&) override {
    throw std::invalid_argument("its mesh cannot change");
  }
  void save(StateWriter*) const override {}
  void restore(StateReader*) override {}

 protected:
  Eigen::VectorXd masses_;  ///< [kg]
};

}  // namespace palpate::tissue
