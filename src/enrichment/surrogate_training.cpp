// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/surrogate_training.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "plain_lbfgs.h"

namespace palpate::enrichment {
namespace {

constexpr std::size_t kLeastSamples = 10;
constexpr double kSeenPart = 0.95, kFlagged = 0.95;

void check(const TrainingSettings& s) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (s.kind != "kernel" && s.kind != "network") refuse("kind must be kernel or network");
  if (s.modes < 1) refuse("modes must be at least 1");
  if (!(s.held_out >= 0.0 && s.held_out < 1.0)) refuse("holdout must be in [0, 1)");
  if (s.iterations < 1) refuse("iterations must be at least 1");
  if (!(s.decay >= 0.0)) refuse("decay must be at least 0");
}

// Reads the radius from "..., patch 0.006 m, ...".
double patchOf(const std::string& made_by) {
  const std::string name = ", patch ";
  const std::size_t at = made_by.find(name);
  const double patch =
      at == std::string::npos ? 0.0 : std::strtod(made_by.c_str() + at + name.size(), nullptr);
  if (!(patch > 0.0 && std::isfinite(patch))) {
    throw std::invalid_argument("the database does not say which patch was pressed");
  }
  return patch;
}

// Modes are from the largest eigenvalues of the samples' Gram matrix.
void takeModes(const std::vector<Deformation>& samples, Eigen::Index modes, Surrogate* surrogate,
               Eigen::MatrixXd* coefficients) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd all(samples.front().fine.size(), n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Points& fine = samples[static_cast<std::size_t>(k)].fine;
    all.col(k) = Eigen::Map<const Eigen::VectorXd>(fine.data(), fine.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> products(all.transpose() * all);
  modes = std::min({modes, n, all.rows()});
  Eigen::MatrixXd basis = all * products.eigenvectors().rightCols(modes).rowwise().reverse();
  for (auto mode : basis.colwise()) {
    if (mode.norm() > 0.0) mode.normalize();
  }
  surrogate->modes = basis.cast<float>();
  *coefficients = surrogate->modes.cast<double>().transpose() * all;
}

double rootOfMeanSquare(const Eigen::MatrixXd& columns) {
  const double root = std::sqrt(columns.squaredNorm() / static_cast<double>(columns.cols()));
  return root > 0.0 ? root : 1.0;
}

// Collects unscaled places and displacements as inputs.
ResponseSamples gather(const DeformationDatabase& database, const std::vector<Deformation>& samples,
                       const Eigen::MatrixXd& coefficients, Surrogate* surrogate) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  ResponseSamples out;
  out.inputs.resize(6, n);
  Eigen::MatrixXd forces(3, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Deformation& sample = samples[static_cast<std::size_t>(k)];
    out.inputs.col(k) << database.fine.points.col(sample.contact), sample.fine.col(sample.contact);
    forces.col(k) = sample.force;
  }
  const Points moved = out.inputs.bottomRows<3>();
  surrogate->longest = moved.colwise().norm().maxCoeff();
  surrogate->displacement_scale = rootOfMeanSquare(moved);
  surrogate->force_scale = rootOfMeanSquare(forces);
  surrogate->mode_scale = rootOfMeanSquare(coefficients);
  out.displacements = moved / surrogate->displacement_scale;
  out.values.resize(3 + coefficients.rows(), n);
  out.values << forces / surrogate->force_scale, coefficients / surrogate->mode_scale;
  const Mat3 square = out.displacements * out.displacements.transpose() +
                      1e-9 * static_cast<double>(n) * Mat3::Identity();
  surrogate->plain = out.values * out.displacements.transpose() * square.inverse();
  out.values -= surrogate->plain * out.displacements;
  return out;
}

ResponseSamples scaled(const ResponseSamples& samples, const Vec6& middle, const Vec6& scale) {
  ResponseSamples out = samples;
  out.inputs = scale.cwiseInverse().asDiagonal() * (samples.inputs.colwise() - middle);
  return out;
}

Vec6 scaleOf(double place, double displacement) {
  Vec6 scale;
  scale << Vec3::Constant(place), Vec3::Constant(displacement);
  return scale;
}

struct Widths {
  double place = 0.0, displacement = 0.0, ridge = 0.0;
};

Widths chooseWidths(const ResponseSamples& samples, const std::vector<int>& places, double longest,
                    const std::function<void(double)>& progress) {
  const auto X = samples.inputs.topRows<3>();
  const double size = (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm();
  const double span = size > 0.0 ? size : 1.0;
  Widths best;
  double least = std::numeric_limits<double>::infinity();
  int k = 0;
  for (const double place : {0.1, 0.2, 0.4, 0.8, 1.6}) {
    for (const double displacement : {0.5, 1.0, 2.0, 4.0}) {
      const ResponseSamples some =
          scaled(samples, Vec6::Zero(), scaleOf(place * span, displacement * longest));
      for (const double ridge : {1e-6, 1e-4, 1e-3, 1e-2}) {
        const double error = leaveGroupsOutError(some, ridge, places);
        if (error < least) {
          least = error;
          best = {place * span, displacement * longest, ridge};
        }
      }
      if (progress) progress(0.5 * ++k / 20.0);
    }
  }
  if (!std::isfinite(least)) throw std::invalid_argument("the samples cannot be learned");
  return best;
}

void findThreshold(const std::vector<int>& places, SeenRegion* seen) {
  const Eigen::Index n = seen->samples.cols();
  std::vector<double> distances;
  for (Eigen::Index k = 0; k < n; ++k) {
    SeenRegion others;
    others.samples.resize(6, n);
    Eigen::Index count = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (places[static_cast<std::size_t>(i)] == places[static_cast<std::size_t>(k)]) continue;
      others.samples.col(count++) = seen->samples.col(i);
    }
    if (count == 0) return;
    others.samples.conservativeResize(Eigen::NoChange, count);
    distances.push_back(others.distance(seen->samples.col(k)));
  }
  std::sort(distances.begin(), distances.end());
  const auto at = static_cast<std::size_t>(kSeenPart * static_cast<double>(n - 1));
  seen->threshold = std::max(distances[at], 1e-12);
}

Perceptron trainNetwork(const ResponseSamples& samples, const TrainingSettings& settings,
                        const std::function<void(double)>& progress) {
  Perceptron network(settings.hidden, samples.values.rows(), settings.seed);
  Eigen::VectorXd parameters = network.parameters();
  const auto loss = [&](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
    network.setParameters(x);
    return network.loss(samples, settings.decay, gradient);
  };
  minimizeByLbfgs(loss, settings.iterations, &parameters, [&](int k, double) {
    if (progress) progress(0.5 + 0.5 * k / settings.iterations);
  });
  network.setParameters(parameters);
  return network;
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<double> ranks;
  for (const double value : values) {
    double rank = 0.0;
    for (const double other : values) rank += other < value ? 1.0 : other == value ? 0.5 : 0.0;
    ranks.push_back(rank);
  }
  return ranks;
}

}  // namespace

namespace {

std::vector<int> drawnOrder(std::size_t samples, int seed) {
  std::vector<int> order(samples);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 random(static_cast<std::uint64_t>(static_cast<std::uint32_t>(seed)));
  for (std::size_t k = samples; k-- > 1;) std::swap(order[k], order[random() % (k + 1)]);
  return order;
}

// Contacts whose samples are all held out.
std::set<int> heldOutPlaces(const DeformationDatabase& database, const TrainingSettings& settings) {
  std::set<int> all, apart;
  for (const Deformation& sample : database.samples) all.insert(sample.contact);
  const std::vector<int> places(all.begin(), all.end()),
      order = drawnOrder(places.size(), settings.seed);
  const auto out = static_cast<std::size_t>(settings.held_out * static_cast<double>(order.size()));
  for (std::size_t k = 0; k < out; ++k) {
    apart.insert(places[static_cast<std::size_t>(order[k])]);
  }
  return apart;
}

}  // namespace

Surrogate trainSurrogate(const DeformationDatabase& database, const TrainingSettings& settings,
                         std::vector<Deformation>* held_out, std::vector<Deformation>* learned,
                         const std::function<void(double)>& progress) {
  check(settings);
  std::vector<Deformation> samples, others;
  const std::set<int> apart = heldOutPlaces(database, settings);
  std::vector<int> places;
  for (const Deformation& sample : database.samples) {
    (apart.count(sample.contact) > 0 ? others : samples).push_back(sample);
    if (apart.count(sample.contact) == 0) places.push_back(sample.contact);
  }
  if (samples.size() < kLeastSamples) {
    throw std::invalid_argument("needs at least " + std::to_string(kLeastSamples) +
                                " samples to learn, and has " + std::to_string(samples.size()));
  }
  Surrogate made;
  made.surface = database.fine;
  made.made_by = database.made_by;
  made.patch = patchOf(database.made_by);
  Eigen::MatrixXd coefficients;
  takeModes(samples, settings.modes, &made, &coefficients);
  const ResponseSamples raw = gather(database, samples, coefficients, &made);
  const Widths widths = chooseWidths(raw, places, made.longest, progress);
  made.seen_scale = scaleOf(widths.place, widths.displacement);
  made.seen.samples = made.seen_scale.cwiseInverse().asDiagonal() * raw.inputs;
  findThreshold(places, &made.seen);
  const Eigen::Index outputs = raw.values.rows();
  if (settings.kind == "kernel") {
    made.scale = made.seen_scale;
    const Eigen::Index most = Perceptron::numParameters(settings.hidden, outputs) / (6 + outputs);
    made.map = KernelMap::fit(scaled(raw, made.middle, made.scale), most, widths.ridge);
  } else {
    made.middle = raw.inputs.rowwise().mean();
    const auto away = (raw.inputs.colwise() - made.middle).eval();
    made.scale = scaleOf(rootOfMeanSquare(away.topRows<3>()) / std::sqrt(3.0),
                         rootOfMeanSquare(away.bottomRows<3>()) / std::sqrt(3.0));
    made.map = trainNetwork(scaled(raw, made.middle, made.scale), settings, progress);
  }
  if (held_out) *held_out = std::move(others);
  if (learned) *learned = std::move(samples);
  return made;
}

SurrogateError errorOf(const Surrogate& surrogate, const DeformationDatabase& database,
                       const std::vector<Deformation>& samples) {
  if (database.fine.points != surrogate.surface.points) {
    throw std::invalid_argument("is of another surface than was learned");
  }
  Surrogate one = surrogate;
  SurrogateError error;
  Eigen::VectorXd work, coefficients;
  Points shape;
  double force_squares = 0.0, squares = 0.0, moved_squares = 0.0, points = 0.0;
  for (const Deformation& sample : samples) {
    const Vec3 place = database.fine.points.col(sample.contact);
    const Vec3 displacement = sample.fine.col(sample.contact);
    Vec3 force;
    one.predict(place, displacement, &work, &force, &coefficients);
    one.shape(coefficients, &shape);
    error.force.push_back((force - sample.force).norm());
    error.part.push_back(error.force.back() / std::max(sample.force.norm(), 1e-12));
    error.strangeness.push_back(one.strangeness(place, displacement));
    force_squares += sample.force.squaredNorm();
    squares += (force - sample.force).squaredNorm();
    error.worst_force = std::max(error.worst_force, error.force.back());
    moved_squares += (shape - sample.fine).squaredNorm();
    points += static_cast<double>(shape.cols());
    error.worst_displacement =
        std::max(error.worst_displacement, (shape - sample.fine).colwise().norm().maxCoeff());
  }
  std::vector<double> parts = error.part;
  std::sort(parts.begin(), parts.end());
  if (!parts.empty()) error.median_force = parts[parts.size() / 2];
  if (force_squares > 0.0) error.relative_force = std::sqrt(squares / force_squares);
  if (points > 0.0) error.displacement = std::sqrt(moved_squares / points);
  return error;
}

Alarms alarmsOf(const std::vector<SurrogateError>& errors, double threshold) {
  Alarms alarms;
  for (const SurrogateError& error : errors) {
    for (std::size_t k = 0; k < error.part.size(); ++k) {
      const bool wrong = error.part[k] > Alarms::kWrong, told = error.strangeness[k] > threshold;
      alarms.wrong += wrong;
      alarms.right += !wrong;
      alarms.flagged += wrong && told;
      alarms.false_alarms += !wrong && told;
    }
  }
  return alarms;
}

void setThreshold(const std::vector<SurrogateError>& errors, Surrogate* surrogate) {
  std::vector<double> wrong;
  double right = 0.0;
  for (const SurrogateError& error : errors) {
    for (std::size_t k = 0; k < error.part.size(); ++k) {
      if (error.part[k] > Alarms::kWrong) {
        wrong.push_back(error.strangeness[k]);
      } else {
        right = std::max(right, error.strangeness[k]);
      }
    }
  }
  if (!wrong.empty()) {
    std::sort(wrong.begin(), wrong.end());
    // If k of n samples are below a threshold, (k + 1)/(n + 1) of similar samples are, on average.
    const double let = (1.0 - kFlagged) * static_cast<double>(wrong.size() + 1) - 1.0;
    const auto missed = static_cast<std::size_t>(std::max(0.0, let));
    right = std::min(right, std::nextafter(wrong[missed], 0.0));
  }
  surrogate->seen.threshold *= std::max(right, 1e-6);
}

void chooseSeen(const std::function<std::vector<SurrogateError>(const Surrogate&)>& errors,
                Surrogate* surrogate) {
  Surrogate best;
  int least = std::numeric_limits<int>::max();
  for (const double factor : {1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1.0, 2.0}) {
    Surrogate other = *surrogate;
    other.seen_scale.tail<3>() *= factor;
    other.seen.samples.bottomRows<3>() /= factor;
    setThreshold(errors(other), &other);
    const int alarms = alarmsOf(errors(other)).false_alarms;
    if (alarms >= least) continue;
    least = alarms;
    best = other;
  }
  *surrogate = best;
}

double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> of_a = ranks(a), of_b = ranks(b);
  const auto n = static_cast<Eigen::Index>(a.size());
  if (n == 0) return 0.0;
  const Eigen::Map<const Eigen::ArrayXd> x(of_a.data(), n), y(of_b.data(), n);
  const Eigen::ArrayXd u = x - x.mean(), v = y - y.mean();
  const double scale = std::sqrt(u.square().sum() * v.square().sum());
  return scale > 0.0 ? (u * v).sum() / scale : 0.0;
}

}  // namespace palpate::enrichment
