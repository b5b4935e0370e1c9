// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/joint_potential.h"

#include <algorithm>

namespace palpate::solver {
namespace {

std::vector<fem::ElasticEnergy*> energiesOf(const std::vector<const Potential*>& members) {
  std::vector<fem::ElasticEnergy*> energies;
  energies.reserve(members.size());
  for (const Potential* member : members) energies.push_back(member->elasticity);
  return energies;
}

}  // namespace

void MappedTerms::gather(const Points& all, Points* own) const {
  own->resize(3, own_.cols());
  for (int i = 0; i < static_cast<int>(own_.cols()); ++i) own->col(i) = all.col(node_map_.of(i));
}

double MappedTerms::value(const Points& x) const {
  gather(x, &own_);
  double sum = 0.0;
  for (const fem::EnergyTerm* term : terms_) sum += term->value(own_);
  return sum;
}

double MappedTerms::addGradient(const Points& x, Points* g) const {
  gather(x, &own_);
  own_d_.setZero();
  double sum = 0.0;
  for (const fem::EnergyTerm* term : terms_) sum += term->addGradient(own_, &own_d_);
  for (int i = 0; i < static_cast<int>(own_.cols()); ++i) g->col(node_map_.of(i)) += own_d_.col(i);
  return sum;
}

void MappedTerms::addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
  gather(x, &own_);
  K->setNodeMap(node_map_);
  for (const fem::EnergyTerm* term : terms_) term->addHessian(own_, tangent, K);
  K->setNodeMap({});
}

double MappedTerms::maxStep(const Points& x, const Points& d) const {
  gather(x, &own_);
  gather(d, &own_d_);
  double largest = 1.0;
  for (const fem::EnergyTerm* term : terms_) {
    largest = std::min(largest, term->maxStep(own_, own_d_));
  }
  return largest;
}

bool MappedTerms::conservative() const {
  return std::all_of(terms_.begin(), terms_.end(),
                     [](const fem::EnergyTerm* term) { return term->conservative(); });
}

JointPotential::JointPotential(const std::vector<const Potential*>& members)
    : members_(members), energy_(energiesOf(members)), all_{&energy_, {}, {}} {
  all_.free.resize(3, energy_.numNodes());
  for (std::size_t k = 0; k < members.size(); ++k) {
    const auto count = static_cast<int>(members[k]->free.cols());
    all_.free.middleCols(firstNode(k), count) = members[k]->free;
    terms_.push_back(std::make_unique<MappedTerms>(members[k]->terms,
                                                   fem::Stiffness::NodeMap{firstNode(k)}, count));
    all_.terms.push_back(terms_.back().get());
  }
}

fem::Stiffness::NodeMap JointPotential::nodeMapOf(std::size_t a, std::size_t b) const {
  if (a == b) return {firstNode(a)};
  return {firstNode(a), static_cast<int>(members_[a]->free.cols()), firstNode(b)};
}

void JointPotential::setFurther(const std::vector<const fem::EnergyTerm*>& terms) {
  all_.terms.resize(members_.size());
  all_.terms.insert(all_.terms.end(), terms.begin(), terms.end());
}

bool JointPotential::takeScales(std::vector<double>* before) {
  bool other = before->size() != members_.size();
  before->resize(members_.size(), 1.0);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const double scale = members_[k]->elastic_scale;
    other = other || (*before)[k] != scale;
    (*before)[k] = scale;
    energy_.setScale(k, scale);
  }
  return other;
}

}  // namespace palpate::solver
