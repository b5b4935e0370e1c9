// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/fem/joint_energy.h"
#include "palpate/solver/potential.h"

namespace palpate::solver {

/// Terms of one body, or of two that interact, as a term of all points of a group.
class MappedTerms final : public fem::EnergyTerm {
 public:
  /// `terms`, not owned, may grow as long as nobody asks. `node_map`: of their `num_nodes` nodes.
  MappedTerms(const std::vector<const fem::EnergyTerm*>& terms,
              const fem::Stiffness::NodeMap& node_map, int num_nodes)
      : terms_(terms), node_map_(node_map), own_(3, num_nodes), own_d_(3, num_nodes) {}

  /// The columns of `all` that are theirs, 3 x num_nodes.
  void gather(const Points& all, Points* own) const;

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;
  double maxStep(const Points& x, const Points& d) const override;
  bool conservative() const override;

 private:
  const std::vector<const fem::EnergyTerm*>& terms_;
  fem::Stiffness::NodeMap node_map_;
  mutable Points own_, own_d_;  // scratch
};

/// Potential of a group: the members' potentials over concatenated points.
class JointPotential {
 public:
  /// @pre The members outlive this and are not moved.
  explicit JointPotential(const std::vector<const Potential*>& members);
  JointPotential(const JointPotential&) = delete;  // the terms refer to each other
  JointPotential& operator=(const JointPotential&) = delete;

  const Potential& all() const { return all_; }
  std::size_t numMembers() const { return members_.size(); }
  int numNodes() const { return energy_.numNodes(); }
  int firstNode(std::size_t member) const { return energy_.firstNode(member); }
  /// Makes a matrix with the pattern of the group.
  fem::Stiffness makeMatrix() const { return energy_.makeMatrix(); }

  /// Node map of two members, or of one twice.
  fem::Stiffness::NodeMap nodeMapOf(std::size_t a, std::size_t b) const;
  /// Sets terms in addition to the members' own, on all points; not owned.
  void setFurther(const std::vector<const fem::EnergyTerm*>& terms);
  /// Takes over the members' scales of the elastic energy, and stores them in `before`. Returns
  /// whether one has changed.
  bool takeScales(std::vector<double>* before);

 private:
  std::vector<const Potential*> members_;
  fem::JointEnergy energy_;
  std::vector<std::unique_ptr<MappedTerms>> terms_;
  Potential all_;
};

}  // namespace palpate::solver
