// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/enrichment/deformations.h"
#include "palpate/enrichment/surrogate.h"

namespace palpate::enrichment {

/// How a surrogate is made of a database.
struct TrainingSettings {
  std::string kind = "kernel";  ///< Or "network".
  std::vector<int> hidden{32,
                          32};  ///< Widths of the network's layers; it sets the kernels' number.
  int modes = 10;               ///< Of the surface's displacements.
  int seed = 1;                 ///< Of the network, and of which samples are held out.
  double held_out = 0.2;        ///< Part of the samples, in [0, 1).
  int iterations = 2000;        ///< Of the network's training.
  double decay = 1e-6;          ///< Of its weights, in the loss.
};

/// What a surrogate misses by, of samples of the same surface.
struct SurrogateError {
  std::vector<double> force;        ///< |F - F'|, a sample each [N].
  std::vector<double> part;         ///< Of |F|.
  std::vector<double> strangeness;  ///< Of the samples.
  double relative_force = 0.0;      ///< Root of the mean square, over that of the forces.
  double median_force = 0.0;        ///< Of |F - F'|/|F|.
  double worst_force = 0.0;         ///< [N]
  double displacement = 0.0;        ///< Root of the mean square over the surface's points [m].
  double worst_displacement = 0.0;  ///< [m]
};

/// Zeros without samples. @throws std::invalid_argument for another surface.
SurrogateError errorOf(const Surrogate& surrogate, const DeformationDatabase& database,
                       const std::vector<Deformation>& samples);

/// How many samples are missed by more than kWrong of their force, and how many of these and of the
/// others are strange.
struct Alarms {
  static constexpr double kWrong = 0.2;
  int wrong = 0, right = 0, flagged = 0, false_alarms = 0;
};

Alarms alarmsOf(const std::vector<SurrogateError>& errors, double threshold = 1.0);

/// Sets what is strange by errors that the surrogate made: so that nineteen twentieths of the
/// samples that are wrong (Alarms) are strange, and what is farther than any that was right.
void setThreshold(const std::vector<SurrogateError>& errors, Surrogate* surrogate);

/// `held_out`, `learned`: which samples were, whole places; may be null. `progress` gets a part in
/// [0, 1]. The widths of kernels and their ridge are those of a grid with the least error when each
/// place that is learned is left out in turn; the scale of what is strange is theirs, and its
/// threshold what 95 % of these samples are nearer than to one of another place.
/// @throws std::invalid_argument for settings out of range, less than 10 samples to learn, or a
/// database that does not say which patch was pressed.
Surrogate trainSurrogate(const DeformationDatabase& database, const TrainingSettings& settings,
                         std::vector<Deformation>* held_out = nullptr,
                         std::vector<Deformation>* learned = nullptr,
                         const std::function<void(double)>& progress = {});

/// The same, with that scale of displacements in what is strange, of some, which is the least often
/// strange where it is right. `errors`: of a surrogate, of the samples to choose by.
void chooseSeen(const std::function<std::vector<SurrogateError>(const Surrogate&)>& errors,
                Surrogate* surrogate);

/// Pearson's correlation of the ranks of a and b [Spearman 1904]; of equal values the mean rank.
double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace palpate::enrichment
