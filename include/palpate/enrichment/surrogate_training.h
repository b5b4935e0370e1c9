// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/enrichment/deformations.h"
#include "palpate/enrichment/surrogate.h"

namespace palpate::enrichment {

/// Settings of training a surrogate from a database.
struct TrainingSettings {
  std::string kind = "kernel";  ///< Or "network".
  std::vector<int> hidden{32,
                          32};  ///< Widths of the network's layers; they set the kernels' number.
  int modes = 10;               ///< Number of displacement modes of the surface.
  int seed = 1;                 ///< For the network and the choice of held-out samples.
  double held_out = 0.2;        ///< Fraction of the samples, in [0, 1).
  int iterations = 2000;        ///< Of the network's training.
  double decay = 1e-6;          ///< Weight decay in the network's loss.
};

/// Errors of a surrogate for samples of the same surface.
struct SurrogateError {
  std::vector<double> force;        ///< |F - F'| of each sample [N].
  std::vector<double> part;         ///< |F - F'|/|F| of each sample.
  std::vector<double> strangeness;  ///< Surrogate::strangeness() of each sample.
  double relative_force = 0.0;      ///< Root mean square error, over that of the forces.
  double median_force = 0.0;        ///< Median of |F - F'|/|F|.
  double worst_force = 0.0;         ///< [N]
  double displacement = 0.0;        ///< Root mean square over the surface's points [m].
  double worst_displacement = 0.0;  ///< [m]
};

/// Zeros without samples. @throws std::invalid_argument for another surface.
SurrogateError errorOf(const Surrogate& surrogate, const DeformationDatabase& database,
                       const std::vector<Deformation>& samples);

/// Numbers of samples with a force error above kWrong, and of strange samples among these and the
/// others.
struct Alarms {
  static constexpr double kWrong = 0.2;
  int wrong = 0, right = 0, flagged = 0, false_alarms = 0;
};

Alarms alarmsOf(const std::vector<SurrogateError>& errors, double threshold = 1.0);

/// Sets the threshold of strangeness by errors of the surrogate, so that 95 % of the wrong samples
/// (Alarms) and all samples beyond every right one are strange.
void setThreshold(const std::vector<SurrogateError>& errors, Surrogate* surrogate);

/// `held_out` and `learned` receive the samples, split by contact; may be null. `progress` gets a
/// fraction in [0, 1]. A grid search chooses kernel widths and ridge by the least error with each
/// learned contact left out in turn. These widths scale the strangeness; its threshold is the 95 %
/// quantile of the distances to samples of other contacts.
/// @throws std::invalid_argument for settings out of range, fewer than 10 samples to learn, or a
/// database without the radius of the press.
Surrogate trainSurrogate(const DeformationDatabase& database, const TrainingSettings& settings,
                         std::vector<Deformation>* held_out = nullptr,
                         std::vector<Deformation>* learned = nullptr,
                         const std::function<void(double)>& progress = {});

/// As setThreshold(), with the scale of displacements, out of several, that makes right samples
/// strange least often. `errors`: computes a surrogate's errors for the samples.
void chooseSeen(const std::function<std::vector<SurrogateError>(const Surrogate&)>& errors,
                Surrogate* surrogate);

/// Pearson's correlation of the ranks of a and b [Spearman 1904]; ties have mean ranks.
double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace palpate::enrichment
