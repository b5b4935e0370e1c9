// SPDX-License-Identifier: GPL-3.0-or-later
#include "prony_history.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace palpate::fem {

PronyHistory::PronyHistory(const Composition& composition, int num_elements, int points_per_element)
    : points_per_element_(points_per_element), solid_of_(composition.solid_of) {
  solid_of_.resize(static_cast<std::size_t>(num_elements), 0);
  bool viscous = false;
  for (const material::Solid& solid : composition.solids) {
    material::checkProny(solid.law, solid.prony);
    terms_.emplace_back();
    for (const material::PronyTerm& term : solid.prony) {
      terms_.back().push_back({term.g, term.tau, 0.0, 0.0});
      viscous = true;
    }
  }
  factor_.assign(terms_.size(), 1.0);
  if (viscous) {
    points_.resize(static_cast<std::size_t>(num_elements) * points_per_element);
    for (int e = 0; e < num_elements; ++e) {
      for (int q = 0; q < points_per_element; ++q) {
        points_[e * points_per_element + q].Q.assign(terms(e).size(), Mat3::Zero());
      }
    }
  }
  beginStep(std::numeric_limits<double>::infinity());
}

void PronyHistory::beginStep(double h) {
  for (std::size_t solid = 0; solid < terms_.size(); ++solid) {
    factor_[solid] = 1.0;
    for (Term& term : terms_[solid]) {
      const double x = h / term.tau;
      term.decay = std::exp(-x);
      term.gain = term.g * (x > 1e-8 ? -std::expm1(-x) / x : 1.0 - 0.5 * x);
      factor_[solid] += term.gain - term.g;
    }
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    const std::vector<Term>& terms = this->terms(static_cast<int>(i) / points_per_element_);
    point.H.setZero();
    for (std::size_t k = 0; k < terms.size(); ++k) {
      point.H += terms[k].decay * point.Q[k] - terms[k].gain * point.S;
    }
  }
}

void PronyHistory::endStep(int e, int q, const Mat3& S) {
  Point& point = points_[e * points_per_element_ + q];
  for (std::size_t k = 0; k < point.Q.size(); ++k) {
    const Term& term = terms(e)[k];
    point.Q[k] = term.decay * point.Q[k] + term.gain * (S - point.S);
  }
  point.S = S;
}

void PronyHistory::relax(int e, int q, const Mat3& S) {
  Point& point = points_[e * points_per_element_ + q];
  for (Mat3& Q : point.Q) Q.setZero();
  point.S = S;
}

void PronyHistory::goOnFrom(const PronyHistory& old, const mesh::MeshChange& change,
                            const std::vector<double>& old_volumes) {
  if (empty() != old.empty() || terms_.size() != old.terms_.size()) {
    throw std::invalid_argument("the body was of other solids");
  }
  terms_ = old.terms_;
  factor_ = old.factor_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const int e = static_cast<int>(i) / points_per_element_;
    const int q = static_cast<int>(i) % points_per_element_;
    const mesh::MeshChange::Range from = change.tets[static_cast<std::size_t>(e)];
    const auto at = [&](int element) -> const Point& {
      return old.points_[static_cast<std::size_t>(element * points_per_element_ + q)];
    };
    points_[i] = at(from.first);
    if (from.last == from.first + 1) continue;
    double volume = 0.0;
    points_[i] = {Mat3::Zero(), Mat3::Zero(), std::vector<Mat3>(terms(e).size(), Mat3::Zero())};
    for (int k = from.first; k < from.last; ++k) volume += old_volumes[k];
    for (int k = from.first; k < from.last; ++k) {
      const double share = old_volumes[k] / volume;
      points_[i].S += share * at(k).S;
      points_[i].H += share * at(k).H;
      for (std::size_t t = 0; t < points_[i].Q.size(); ++t) points_[i].Q[t] += share * at(k).Q[t];
    }
  }
}

void PronyHistory::save(StateWriter* out) const {
  out->put(static_cast<std::int64_t>(points_.size()));
  if (points_.empty()) return;
  out->put(factor_);
  for (const std::vector<Term>& terms : terms_) {
    for (const Term& term : terms) {
      out->put(term.decay);
      out->put(term.gain);
    }
  }
  for (const Point& point : points_) {
    out->put(point.S);
    out->put(point.H);
    for (const Mat3& Q : point.Q) out->put(Q);
  }
}

void PronyHistory::restore(StateReader* in) {
  if (in->count(1) != static_cast<std::int64_t>(points_.size())) StateReader::fail();
  if (points_.empty()) return;
  in->getSame(&factor_);
  for (std::vector<Term>& terms : terms_) {
    for (Term& term : terms) {
      in->get(&term.decay);
      in->get(&term.gain);
    }
  }
  for (Point& point : points_) {
    in->get(&point.S);
    in->get(&point.H);
    for (Mat3& Q : point.Q) in->get(&Q);
  }
}

}  // namespace palpate::fem
