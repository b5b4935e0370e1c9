// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "enriched_bodies.h"
#include "palpate/enrichment/enriched_shape.h"
#include "palpate/io/json.h"
#include "parts.h"

namespace palpate::models {
namespace {

using enrichment::Deformation;
using enrichment::DeformationDatabase;
using enrichment::EnrichedShape;
using enrichment::FeatureSettings;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string list(const std::vector<double>& values) {
  return io::json(
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

/// Root mean square over samples and points, in parts of that of the displacements.
class Error {
 public:
  void add(const Points& ours, const Points& truth) {
    squares_ += (ours - truth).squaredNorm();
    all_ += truth.squaredNorm();
    points_ += static_cast<double>(truth.cols());
  }
  double relative() const { return std::sqrt(squares_ / all_); }
  double displacement() const { return std::sqrt(all_ / points_); }  // [m]

 private:
  double squares_ = 0.0, all_ = 0.0, points_ = 0.0;
};

/// How the tests are made fine, each from the coarse points' displacements.
struct Way {
  std::string name;
  FeatureSettings feature;
};

struct Experiment {
  EnrichedBody body;
  DeformationDatabase data;        // what is learned from
  std::vector<Deformation> tests;  // of the fine elements
  std::vector<Points> coarse;      // of the coarse elements, under the same presses
  std::vector<mesh::SurfacePoint> embedding;
  std::vector<double> fine_seconds, coarse_seconds;
  Eigen::Index fine_nodes = 0, coarse_nodes = 0;
  int unsolved = 0;  // presses that are left out

  Experiment(EnrichedBody made, bool quick) : body(std::move(made)) {
    if (quick) {
      body.train = 4;
      body.test = 2;
    }
    data.coarse = body.coarse;
    data.fine = body.fine;
    embedding = mesh::nearestSurfacePoints(body.coarse, body.fine.points);
    press();
  }

  void press() {
    const auto fine =
        pressedBody(body, filled(body.true_surface, {body.fine_edge, {}}), body.fine.points);
    const auto simple =
        pressedBody(body, filled(body.true_surface, {body.coarse_edge, {}}), body.coarse.points);
    fine_nodes = fine->mesh().numPoints();
    coarse_nodes = simple->mesh().numPoints();
    for (int i = 0; static_cast<int>(tests.size()) < body.test; ++i) {
      Deformation sample = enrichment::drawPress(body.plan, body.coarse, body.contacts, i);
      const bool test = static_cast<int>(data.samples.size()) == body.train;
      const std::optional<double> seconds = solve(fine.get(), sample, &sample.fine);
      Points simply;
      const std::optional<double> simple_seconds =
          test ? solve(simple.get(), sample, &simply) : std::optional<double>(0.0);
      if (!seconds || !simple_seconds) {
        if (++unsolved > body.test) throw std::runtime_error(body.name + " cannot be pressed so");
      } else if (!test) {
        data.samples.push_back(sample);
      } else {
        fine_seconds.push_back(*seconds);
        tests.push_back(sample);
        coarse.push_back(simply);
        coarse_seconds.push_back(*simple_seconds);
      }
    }
  }

  // Seconds, if it was solved.
  std::optional<double> solve(enrichment::PressedBody* with, const Deformation& sample,
                              Points* u) const {
    solver::StaticSettings settings;
    settings.tolerance = 1e-6;
    const double begin = now();
    const solver::StaticReport report =
        with->press({body.coarse.points.col(sample.contact), sample.force}, settings, u);
    if (report.status != solver::SolveStatus::kConverged) return {};
    return now() - begin;
  }

  // Of the tests by a regressor, from the fine elements' own coarse points or the coarse elements'.
  double error(EnrichedShape* shape, bool sampled) const {
    Error error;
    Points fine;
    for (std::size_t k = 0; k < tests.size(); ++k) {
      shape->predict(tests[k].contact, sampled ? tests[k].fine : coarse[k], &fine);
      error.add(fine, tests[k].fine);
    }
    return error.relative();
  }

  // By linear interpolation on the coarse triangles.
  double embeddingError(bool sampled) const {
    Error error;
    Points fine;
    for (std::size_t k = 0; k < tests.size(); ++k) {
      mesh::interpolate(embedding, sampled ? tests[k].fine : coarse[k], &fine);
      error.add(fine, tests[k].fine);
    }
    return error.relative();
  }

  double displacement() const {
    Error error;
    for (const Deformation& test : tests) error.add(test.fine, test.fine);
    return error.displacement();
  }
};

// Seconds of one prediction, the median of 101.
double predictionTime(const Experiment& experiment, EnrichedShape* shape) {
  std::vector<double> times;
  Points fine;
  for (std::size_t k = 0; k < 101; ++k) {
    const Deformation& test = experiment.tests[k % experiment.tests.size()];
    const double begin = now();
    shape->predict(test.contact, test.fine, &fine);
    times.push_back(now() - begin);
  }
  std::nth_element(times.begin(), times.begin() + 50, times.end());
  return times[50];
}

// The same presses by meshes that are fine about the contact only, made for each.
std::string graded(const Experiment& experiment) {
  Error error;
  double solving = 0.0, nodes = 0.0;
  const std::size_t count = std::min<std::size_t>(5, experiment.tests.size());
  for (std::size_t k = 0; k < count; ++k) {
    const Deformation& test = experiment.tests[k];
    mesh::SizeField field;
    field.coarsest = experiment.body.coarse_edge;
    mesh::RefinementZone place;
    place.finest = experiment.body.fine_edge;
    place.radius = experiment.body.patch;
    place.where = mesh::Polyline{{experiment.body.coarse.points.col(test.contact)}};
    field.near.push_back(place);
    const auto body = pressedBody(experiment.body, filled(experiment.body.true_surface, field),
                                  experiment.body.fine.points);
    nodes += static_cast<double>(body->mesh().numPoints());
    Points u;
    const std::optional<double> seconds = experiment.solve(body.get(), test, &u);
    if (!seconds) throw std::runtime_error(experiment.body.name + ": not solved on a graded mesh");
    solving += *seconds;
    error.add(u, test.fine);
  }
  io::JsonMembers out;
  out.add("tests", static_cast<double>(count));
  out.add("error", error.relative());
  out.add("seconds", solving / static_cast<double>(count));
  out.add("nodes", nodes / static_cast<double>(count));
  return out.object();
}

std::string figuresOf(const Experiment& experiment) {
  const std::vector<double> widths{0.02, 0.05, 0.1, 0.15, 0.2,
                                   0.3,  0.45, 0.7, 1.0,  2.0};  // spreads
  std::vector<Way> ways(4);
  ways[0] = {"from_contact", {}};
  ways[1] = {"all_from_contact", {true, 0}};
  ways[2] = {"all_by_number", {false, 0}};
  ways[3] = {"residual", {true, 10, true}};
  io::JsonMembers out;
  out.add("coarse_points", static_cast<double>(experiment.body.coarse.points.cols()));
  out.add("coarse_triangles", static_cast<double>(experiment.body.coarse.triangles.cols()));
  out.add("fine_points", static_cast<double>(experiment.body.fine.points.cols()));
  out.add("fine_triangles", static_cast<double>(experiment.body.fine.triangles.cols()));
  out.add("fine_nodes", static_cast<double>(experiment.fine_nodes));
  out.add("coarse_nodes", static_cast<double>(experiment.coarse_nodes));
  out.add("train", static_cast<double>(experiment.data.samples.size()));
  out.add("test", static_cast<double>(experiment.tests.size()));
  out.add("unsolved", static_cast<double>(experiment.unsolved));
  out.add("displacement", experiment.displacement());
  out.add("fine_seconds", list(experiment.fine_seconds));
  out.add("coarse_seconds", list(experiment.coarse_seconds));
  out.add("widths", list(widths));
  for (const Way& way : ways) {
    std::vector<double> sampled, simulated;
    const double spread = EnrichedShape(experiment.data, way.feature, 1.0).spread();
    double seconds = 0.0;
    for (const double width : widths) {
      EnrichedShape shape(experiment.data, way.feature, width * spread);
      sampled.push_back(experiment.error(&shape, true));
      simulated.push_back(experiment.error(&shape, false));
      seconds = predictionTime(experiment, &shape);
    }
    io::JsonMembers of;
    of.add("spread", spread);
    of.add("sampled", list(sampled));
    of.add("simulated", list(simulated));
    of.add("seconds", seconds);
    out.add(way.name, of.object());
  }
  out.add("embedded_sampled", experiment.embeddingError(true));
  out.add("embedded_simulated", experiment.embeddingError(false));
  out.add("graded", graded(experiment));
  return out.object();
}

}  // namespace

std::string enriched(bool quick) {
  io::JsonMembers out;
  out.add("cylinder", figuresOf(Experiment(cylinderBody(), quick)));
  if (!quick) out.add("liver", figuresOf(Experiment(liverBody(), quick)));
  return out.object();
}

}  // namespace palpate::models
