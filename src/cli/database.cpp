// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "command.h"
#include "commands.h"
#include "options.h"
#include "organ_choice.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/enrichment/sample_maker.h"
#include "palpate/scene/organ_assembly.h"
#include "palpate/scene/pressed_organ.h"
#include "progress_line.h"
#include "shipped.h"

namespace palpate::cli {
namespace {

struct DatabaseOptions {
  std::string scene, organ, out, part = "0/1";
  std::optional<std::string> within;
  enrichment::DatabasePlan plan;
  int threads = 1;
  double cone = 30.0;  // [degree]
};

// Samples k, k + n, k + 2 n ... of all: "k/n".
enrichment::SharePart shareOf(const std::string& text) {
  enrichment::SharePart share;
  char end = 0, slash = 0;
  std::istringstream in(text);
  const bool read =
      static_cast<bool>(in >> share.part >> slash >> share.of) && slash == '/' && !(in >> end);
  if (!read || share.part < 0 || share.of < 1 || share.part >= share.of) {
    throw InputError("command line", "--part", text, "must be K/N with K from 0 to N-1");
  }
  return share;
}

enrichment::PressBall ballOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> numbers;
  for (std::string item; std::getline(in, item, ',');) {
    numbers.push_back(parseNumber(item).value_or(std::nan("")));
  }
  if (numbers.size() != 4 || !std::isfinite(numbers[0] + numbers[1] + numbers[2] + numbers[3]) ||
      !(numbers[3] > 0.0)) {
    throw InputError("command line", "--within", text, "must be X,Y,Z,R in metres, R above 0");
  }
  return {{numbers[0], numbers[1], numbers[2]}, numbers[3]};
}

void check(const DatabaseOptions& options) {
  requirePositive("--force", options.plan.press.force);
  requirePositive("--cone", options.cone);
  if (options.plan.edge_length) requirePositive("--edge-length", *options.plan.edge_length);
  if (options.plan.patch) requirePositive("--patch", *options.plan.patch);
}

scene::PressedOrgan pressedOrgan(const DatabaseOptions& options, start::ProgressLine* line) {
  const scene::Scene scene = scene::readScene(start::sceneFile(options.scene));
  const int index = static_cast<int>(organIndex(scene, options.organ));
  const scene::Progress no_progress;
  std::vector<std::string> repairs;
  const tissue::OrganDescription description =
      scene::describeOrgan(scene, index, no_progress, &repairs);
  try {
    return scene::describePresses(
        scene, index, description, options.plan,
        [&](const std::string& what, double part) { line->show(what, part); });
  } catch (const std::invalid_argument& error) {
    throw InputError("command line", "--triangles", std::to_string(options.plan.triangles),
                     error.what());
  }
}

int runDatabase(DatabaseOptions options) {
  const enrichment::SharePart share = shareOf(options.part);
  check(options);
  if (options.within) options.plan.within = ballOf(*options.within);
  options.plan.press.cone = options.cone * std::acos(-1.0) / 180.0;
  start::ProgressLine line;
  const scene::PressedOrgan organ = pressedOrgan(options, &line);
  enrichment::SampleMaker maker(options.out, organ.surfaces, options.plan.samples, share);
  maker.run(options.threads, [&](const std::string& what, double part) { line.show(what, part); });
  line.finish();
  const mesh::SurfaceMesh &coarse = organ.surfaces.coarse, &fine = organ.surfaces.fine;
  std::cout << options.out << "\n  surfaces         " << coarse.points.cols() << " points, "
            << coarse.triangles.cols() << " triangles; " << fine.points.cols() << " points, "
            << fine.triangles.cols() << " triangles\n"
            << "  body             " << organ.nodes << " nodes, " << organ.tetrahedra
            << " tetrahedra\n"
            << "  samples          " << maker.wanted() << " of this part, " << maker.made()
            << " made now, " << maker.unsolved() << " of them not solved\n";
  return maker.unsolved() > 0 ? kNotConverged : kOk;
}

}  // namespace

void addDatabase(CLI::App& app, Action& action) {
  Command command(app, "database",
                  "Press an organ again and again, for models that learn how it deforms; what is "
                  "there already is kept");
  const auto options = std::make_shared<DatabaseOptions>();
  enrichment::DatabasePlan& plan = options->plan;
  command.option("scene", &options->scene, "Scene file, or name of a shipped scene").required();
  command.option("--organ", &options->organ, "Its organ; may be left out where there is one only");
  command.option("--out", &options->out, "Folder, made if it is not there").required();
  command.option("--samples", &plan.samples, "How many presses in all; 60 if not given")
      .between(1, 999999);
  command.option("--force", &plan.press.force, "The largest [N]; the smallest is a quarter of it")
      .required();
  command.option("--cone", &options->cone,
                 "Largest angle to the inward normal [degree]; 30 if not given");
  command.option("--seed", &plan.press.seed, "Of the presses; 1 if not given");
  command.option("--triangles", &plan.triangles, "Of the coarse surface; 276 if not given")
      .between(4, 1000000);
  command
      .option("--splits", &plan.splits,
              "How often each is cut in four, to the fine surface; 2 if not given")
      .between(0, 5);
  command.option("--edge-length", &plan.edge_length,
                 "Of the tetrahedra [m]; the fine surface's mean if not given");
  command.option("--patch", &plan.patch,
                 "Radius of what is pressed [m]; the coarse surface's mean edge if not given");
  command.option("--within", &options->within,
                 "X,Y,Z,R: press only in this ball, in the organ's frame [m]");
  command.option("--part", &options->part,
                 "K/N: samples K, K + N, K + 2 N ... only, for N programs at once");
  command.option("--threads", &options->threads, "Presses solved at once; 1 if not given")
      .between(1, 256);
  command.onUse([options, &action] { action = [options] { return runDatabase(*options); }; });
}

}  // namespace palpate::cli
