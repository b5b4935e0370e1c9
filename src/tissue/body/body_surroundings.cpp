// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/fem/loads.h"

namespace palpate::tissue {

BodySurroundings::BodySurroundings(const Surroundings& surroundings, const mesh::TetMesh& mesh)
    : moves_(!surroundings.carried.empty()),
      damps_(surroundings.damps()),
      resists_volumes_(surroundings.resistsVolumes()) {
  std::vector<bool> taken(static_cast<std::size_t>(mesh.numPoints()), false);
  for (auto c = surroundings.carried.rbegin(); c != surroundings.carried.rend(); ++c) {
    Carried carried{{}, {}, c->motion};
    for (const int i : c->nodes) {
      if (!taken[static_cast<std::size_t>(i)]) carried.nodes.push_back(i);
      taken[static_cast<std::size_t>(i)] = true;
    }
    carried.rest = mesh.points(Eigen::all, carried.nodes);
    carried_.push_back(carried);
  }
  holds_still_ = (movable(surroundings.free).array() == 0.0).any();
  if (surroundings.springs.empty() && surroundings.pressures.empty()) return;
  const Eigen::MatrixXi surface = mesh::boundaryFaces(mesh);
  for (const SpringSupport& s : surroundings.springs) {
    const Eigen::MatrixXi faces = fem::selectFaces(surface, s.nodes);
    springs_.push_back({fem::Foundation(mesh.points, faces, s.constants), s.motion});
    moves_ = moves_ || s.motion.has_value();
  }
  for (const PressedFaces& p : surroundings.pressures) {
    cavities_.emplace_back(mesh.points, fem::selectFaces(surface, p.nodes), p.content);
  }
}

std::vector<const fem::EnergyTerm*> BodySurroundings::terms() const {
  std::vector<const fem::EnergyTerm*> terms;
  for (const Springs& s : springs_) terms.push_back(&s.foundation);
  for (const fem::CavityPressure& c : cavities_) terms.push_back(&c);
  return terms;
}

bool BodySurroundings::actsAtRest() const {
  return std::any_of(cavities_.begin(), cavities_.end(),
                     [](const fem::CavityPressure& c) { return c.actsAtRest(); });
}

void BodySurroundings::setFactor(double factor) {
  for (fem::CavityPressure& c : cavities_) c.setFactor(factor);
}

void BodySurroundings::seal(const Points& x) {
  for (fem::CavityPressure& c : cavities_) c.seal(x);
}

double BodySurroundings::largestPressure(const Points& x) const {
  double largest = 0.0;
  for (const fem::CavityPressure& c : cavities_) largest = std::max(largest, c.pressure(x));
  return largest;
}

void BodySurroundings::moveTo(double s) {
  for (Springs& springs : springs_) {
    if (springs.motion) springs.foundation.moveAnchors(springs.motion->at(at(s)));
  }
}

void BodySurroundings::beginStep(double h, const Points& x) {
  for (Springs& s : springs_) s.foundation.beginStep(h, x);
}

void BodySurroundings::carry(double s, const Points& x, Points* way) const {
  way->setZero(3, x.cols());
  for (const Carried& c : carried_) {
    const Vec3 offset = c.motion.at(at(s));
    for (std::size_t k = 0; k < c.nodes.size(); ++k) {
      const int i = c.nodes[k];
      way->col(i) = c.rest.col(static_cast<Eigen::Index>(k)) + offset - x.col(i);
    }
  }
}

void BodySurroundings::carryTo(double s, Points* x, int first) const {
  for (const Carried& c : carried_) {
    const Vec3 offset = c.motion.at(at(s));
    for (std::size_t k = 0; k < c.nodes.size(); ++k) {
      x->col(first + c.nodes[k]) = c.rest.col(static_cast<Eigen::Index>(k)) + offset;
    }
  }
}

Vec3 BodySurroundings::commonWay(double s) const {
  std::optional<Vec3> common;
  bool alike = !holds_still_;
  const auto take = [&](const Vec3& way) {
    alike = alike && way == common.value_or(way);
    common = way;
  };
  for (const Carried& c : carried_) take(c.motion.at(at(s)));
  for (const Springs& springs : springs_) {
    take(springs.motion ? springs.motion->at(at(s)) : Vec3::Zero());
  }
  return alike ? common.value_or(Vec3::Zero()) : Vec3::Zero();
}

void BodySurroundings::rest() {
  moveTo(1.0);
  for (Springs& s : springs_) s.foundation.beginStep(std::numeric_limits<double>::infinity(), {});
}

void BodySurroundings::reset() {
  time_ = cycle_ = 0.0;
  rest();
}

fem::FreeMask BodySurroundings::movable(fem::FreeMask free) const {
  for (const Carried& c : carried_) {
    for (const int i : c.nodes) free.col(i).setOnes();
  }
  return free;
}

std::vector<fem::HeldDirection> BodySurroundings::heldDirections() const {
  std::vector<fem::HeldDirection> held;
  for (const Springs& s : springs_) s.foundation.addHeldDirections(&held);
  return held;
}

// The sum of the terms' largest eigenvalues bounds that of their sum [Weyl 1912].
double BodySurroundings::largestSquare(const Points& X, const Eigen::VectorXd& masses) const {
  double sum = 0.0;
  for (const Springs& s : springs_) sum += s.foundation.largestSquare(masses);
  for (const fem::CavityPressure& c : cavities_) sum += c.largestSquare(X, masses);
  return sum;
}

// @pre The cavities are the same, in the same order.
void BodySurroundings::goOnFrom(const BodySurroundings& old) {
  time_ = old.time_;
  for (std::size_t k = 0; k < cavities_.size(); ++k) {
    cavities_[k].setSealedVolume(old.cavities_[k].sealedVolume());
  }
}

void BodySurroundings::save(StateWriter* out) const {
  if (moves_) out->put(time_);
  for (const fem::CavityPressure& c : cavities_) out->put(c.sealedVolume().value_or(0.0));
}

void BodySurroundings::restore(StateReader* in) {
  if (moves_) in->get(&time_);
  if (!(time_ >= 0.0) || !std::isfinite(time_)) StateReader::fail();
  for (fem::CavityPressure& c : cavities_) {
    double volume = 0.0;
    in->get(&volume);
    if (!std::isfinite(volume)) StateReader::fail();
    c.setSealedVolume(volume != 0.0 ? std::optional<double>(volume) : std::nullopt);
  }
}

}  // namespace palpate::tissue
