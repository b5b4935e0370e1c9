// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "palpate/solver/line_search.h"
#include "palpate/solver/minimizer.h"

namespace palpate::solver {

class StaleFactor;

/// L-BFGS [Nocedal, Wright 2006, alg. 7.4] with the Cholesky factor of an earlier stiffness as
/// initial Hessian [Liu, Bouaziz, Kavan 2017, sec. 4], and present diagonal blocks of the other
/// terms (inertia, contact). An iteration costs one triangular solve. The factor is renewed where
/// extra iterations have cost as much, or where the line search fails.
class Lbfgs final : public Minimizer {
 public:
  /// `A` has the body's pattern.
  explicit Lbfgs(fem::Stiffness A);
  ~Lbfgs() override;

  /// Iterations are cheaper than Newton's.
  int iterationsForOne() const override { return 10; }
  NewtonReport minimize(const Potential& potential, const NewtonSettings& settings,
                        Points* x) override;
  double factorSeconds() const override;
  SolveStatus predict(const Potential& potential, const Points& move, Points* x) override;
  const Points& gradient() const override { return g_; }
  double roundoffForce(const Points& x) const override;
  void prepare(const Potential& potential, const Points& x) override {
    renew(potential, x, nullptr);
  }
  void restart() override;
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  static constexpr int kPairs = 5;
  struct Pair {
    Points s, y;
    double sy = 0.0, alpha = 0.0;
  };

  SolveStatus renew(const Potential& potential, const Points& x, PhaseTimes* phases);
  bool scaleFactor(const Potential& potential, const Points& x);
  bool direction(const Potential& potential, const Points& x, PhaseTimes* phases);
  bool search(const Potential& potential, const NewtonSettings& settings, Points* x, double* value,
              NewtonReport* report);
  void learn(const Potential& potential, const Points& x);
  /// The k-th newest pair.
  Pair& pair(int k) { return pairs_[(newest_ + kPairs - k) % kPairs]; }
  const Pair& pair(int k) const { return pairs_[(newest_ + kPairs - k) % kPairs]; }

  fem::Stiffness A_;
  std::unique_ptr<StaleFactor> factor_;
  double renewal_;  // what a factorisation costs, in iterations
  double wasted_ = 0.0;
  std::vector<Mat3> elastic_diagonal_, diagonal_;
  fem::Stiffness terms_;
  std::array<Pair, kPairs> pairs_;
  int num_pairs_ = 0, newest_ = 0;
  LineSearch line_search_;
  Points g_, d_, right_, x_begin_, g_begin_, x_trial_;
};

}  // namespace palpate::solver
