// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/rank_ones.h"

namespace palpate::fem {

RankOnes::Term& RankOnes::add(const std::vector<int>& nodes, const Points& a, double c) {
  if (count_ == terms_.size()) terms_.emplace_back();
  Term& term = terms_[count_++];
  term.nodes = nodes;
  term.a = a;
  term.c = c;
  return term;
}

void RankOnes::addProduct(const Points& x, Points* y) const {
  for (std::size_t t = 0; t < count_; ++t) {
    const Term& term = terms_[t];
    double sum = 0.0;
    for (std::size_t k = 0; k < term.nodes.size(); ++k) {
      sum += term.a.col(static_cast<Eigen::Index>(k)).dot(x.col(term.nodes[k]));
    }
    sum *= term.c;
    for (std::size_t k = 0; k < term.nodes.size(); ++k) {
      y->col(term.nodes[k]) += sum * term.a.col(static_cast<Eigen::Index>(k));
    }
  }
}

void RankOnes::scale(double s) {
  for (std::size_t t = 0; t < count_; ++t) terms_[t].c *= s;
}

void RankOnes::constrain(const Eigen::Matrix3Xd& free) {
  for (std::size_t t = 0; t < count_; ++t) {
    Term& term = terms_[t];
    for (std::size_t k = 0; k < term.nodes.size(); ++k) {
      term.a.col(static_cast<Eigen::Index>(k)).array() *= free.col(term.nodes[k]).array();
    }
  }
}

void RankOnes::save(StateWriter* out) const {
  out->put(static_cast<std::int64_t>(count_));
  for (std::size_t t = 0; t < count_; ++t) {
    out->put(terms_[t].nodes);
    out->put(terms_[t].a);
    out->put(terms_[t].c);
  }
}

void RankOnes::restore(StateReader* in, int num_nodes) {
  clear();
  for (std::int64_t t = in->count(static_cast<std::int64_t>(sizeof(double))); t > 0; --t) {
    Term term;
    in->get(&term.nodes);
    in->get(&term.a);
    in->get(&term.c);
    if (term.a.cols() != static_cast<Eigen::Index>(term.nodes.size())) StateReader::fail();
    for (const int i : term.nodes) {
      if (i < 0 || i >= num_nodes) StateReader::fail();
    }
    add(term.nodes, term.a, term.c);
  }
}

}  // namespace palpate::fem
