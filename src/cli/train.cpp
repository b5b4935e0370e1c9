// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "command.h"
#include "commands.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/enrichment/database_folder.h"
#include "palpate/enrichment/surrogate_file.h"
#include "palpate/enrichment/surrogate_training.h"
#include "progress_line.h"

namespace palpate::cli {
namespace {

struct TrainOptions {
  std::string database, out;
  std::optional<std::string> hidden, check, far;
  enrichment::TrainingSettings training;
};

std::vector<int> widthsOf(const std::string& text) {
  std::vector<int> widths;
  std::istringstream in(text);
  for (std::string item; std::getline(in, item, ',');) {
    const std::optional<double> width = parseNumber(item);
    if (!width || !(*width >= 1.0 && *width <= 1024.0) || *width != std::floor(*width)) {
      throw InputError("command line", "--hidden", text,
                       "must be whole numbers 1 to 1024, as 32,32");
    }
    widths.push_back(static_cast<int>(*width));
  }
  if (widths.empty() || widths.size() > 8) {
    throw InputError("command line", "--hidden", text, "must be of 1 to 8 layers");
  }
  return widths;
}

// Mean time of a prediction [s], of all samples again and again.
double timeOf(enrichment::Surrogate surrogate, const enrichment::DeformationDatabase& database,
              bool shape) {
  using Clock = std::chrono::steady_clock;
  Eigen::VectorXd work, coefficients;
  Vec3 force;
  const auto begin = Clock::now();
  int number = 0;
  double seconds = 0.0;
  while (seconds < 0.2) {
    for (const enrichment::Deformation& sample : database.samples) {
      surrogate.predict(database.fine.points.col(sample.contact), sample.fine.col(sample.contact),
                        &work, &force, shape ? &coefficients : nullptr);
      ++number;
    }
    seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  return seconds / number;
}

void print(const char* name, const enrichment::SurrogateError& error) {
  if (error.force.empty()) return;
  const enrichment::Alarms alarms = enrichment::alarmsOf({error});
  std::cout << "  " << name << error.force.size() << " samples, force "
            << 100.0 * error.relative_force << " % (median " << 100.0 * error.median_force
            << " %, worst " << error.worst_force << " N), displacement " << 1e3 * error.displacement
            << " mm (worst " << 1e3 * error.worst_displacement << " mm), " << alarms.flagged
            << " of " << alarms.wrong << " that are missed by more than 20 % are strange, and "
            << alarms.false_alarms << " of " << alarms.right << " others; rank correlation of both "
            << enrichment::rankCorrelation(error.strangeness, error.force) << "\n";
}

// Which contacts are of the first half, for one half of the samples to set what is strange and the
// other to tell whether it holds.
using Halves = std::array<std::vector<enrichment::Deformation>, 2>;

Halves halvesByContact(const std::vector<enrichment::Deformation>& samples) {
  std::map<int, std::size_t> half;
  for (const enrichment::Deformation& sample : samples) half.emplace(sample.contact, 0);
  std::size_t k = 0;
  for (auto& [contact, of] : half) of = k++ % 2;
  Halves halves;
  for (const enrichment::Deformation& sample : samples) {
    halves[half[sample.contact]].push_back(sample);
  }
  return halves;
}

// Of another database of the surface.
template <class Tell>
void withSamplesOf(const std::string& folder, const Tell& tell) {
  const enrichment::DeformationDatabase other = enrichment::readDatabase(folder);
  try {
    tell(other);
  } catch (const std::invalid_argument& error) {
    throw InputError(folder, "", "", error.what());
  }
}

void chooseSeen(const enrichment::DeformationDatabase& database,
                const std::vector<enrichment::Deformation>& held_out, const std::string& far,
                enrichment::Surrogate* made) {
  withSamplesOf(far, [&](const enrichment::DeformationDatabase& other) {
    const Halves near_halves = halvesByContact(held_out),
                 far_halves = halvesByContact(other.samples);
    const auto errors = [&](const enrichment::Surrogate& of, std::size_t half) {
      return std::vector<enrichment::SurrogateError>{
          enrichment::errorOf(of, database, near_halves[half]),
          enrichment::errorOf(of, other, far_halves[half])};
    };
    enrichment::chooseSeen([&](const enrichment::Surrogate& of) { return errors(of, 0); }, made);
    for (const std::size_t half : {0U, 1U}) {
      const enrichment::Alarms alarms = enrichment::alarmsOf(errors(*made, half));
      std::cout << (half == 0 ? "  strange is set by half of these and of what is held out: "
                              : "  of the other half: ")
                << alarms.flagged << " of " << alarms.wrong
                << " that are missed by more than 20 %, and " << alarms.false_alarms << " of "
                << alarms.right << " others\n";
    }
  });
}

int runTrain(const TrainOptions& options) {
  enrichment::TrainingSettings training = options.training;
  if (options.hidden) training.hidden = widthsOf(*options.hidden);
  const enrichment::DeformationDatabase database = enrichment::readDatabase(options.database);
  std::vector<enrichment::Deformation> held_out, learned;
  start::ProgressLine line;
  enrichment::Surrogate made;
  try {
    made = enrichment::trainSurrogate(database, training, &held_out, &learned,
                                      [&](double part) { line.show("learning", part); });
  } catch (const std::invalid_argument& error) {
    throw InputError(options.database, "", "", error.what());
  }
  line.finish();
  if (options.far) chooseSeen(database, held_out, *options.far, &made);
  enrichment::writeSurrogate(options.out, made);
  std::cout << options.out << "\n  " << training.kind << "   " << made.numParameters()
            << " parameters, " << made.numModes() << " modes of " << made.surface.points.cols()
            << " points; widths " << made.seen_scale[0] << " m of places, " << made.seen_scale[3]
            << " m of displacements\n  a prediction " << 1e6 * timeOf(made, database, false)
            << " us, with the shape's modes " << 1e6 * timeOf(made, database, true) << " us\n";
  print("learned   ", enrichment::errorOf(made, database, learned));
  print("held out  ", enrichment::errorOf(made, database, held_out));
  if (options.check) {
    withSamplesOf(*options.check, [&](const enrichment::DeformationDatabase& other) {
      print("checked   ", enrichment::errorOf(made, other, other.samples));
    });
  }
  return kOk;
}

}  // namespace

void addTrain(CLI::App& app, Action& action) {
  Command command(app, "train",
                  "Learn a body's answer to presses from a database; says what it misses by");
  const auto options = std::make_shared<TrainOptions>();
  enrichment::TrainingSettings& training = options->training;
  command.option("database", &options->database, "Folder that `palpate database` made").required();
  command.option("--out", &options->out, "File of the surrogate").required();
  command.option("--kind", &training.kind, "kernel if not given, or network")
      .oneOf({"kernel", "network"});
  command.option("--hidden", &options->hidden,
                 "Widths of the network's layers; kernels get as many parameters; 32,32 if not "
                 "given");
  command.option("--modes", &training.modes, "Of the surface's displacements; 10 if not given")
      .between(1, 1000);
  command.option("--seed", &training.seed,
                 "Of the network and of what is held out; 1 if not given");
  command.option("--holdout", &training.held_out,
                 "Part of the samples that is not learned, in [0, 1); 0.2 if not given");
  command.option("--iterations", &training.iterations, "Of the network; 2000 if not given")
      .between(1, 1000000);
  command.option("--decay", &training.decay, "Of the network's weights; 1e-6 if not given");
  command.option("--far", &options->far,
                 "Another database of the same surface, of presses that go farther: what is "
                 "strange is set by what these and those held out are missed by");
  command.option("--check", &options->check, "Another database of the same surface to predict");
  command.onUse([options, &action] { action = [options] { return runTrain(*options); }; });
}

}  // namespace palpate::cli
