// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "command.h"
#include "commands.h"
#include "files.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/skin/limits.h"
#include "skin_block.h"
#include "skin_tables.h"

namespace palpate::cli {
namespace {

using SkinClock = std::chrono::steady_clock;

constexpr double kAcceptable = 1.1;  // times the least criterion

struct SkinOptions {
  skin::TwoLayerBlock block;
  std::string variant{toString(skin::TwoLayerBlock().idealization)}, mesh, diagonals = "one_way";
  std::string ratios = "geometric", protocol = "converged", out;
  double fraction = 0.5;
  std::optional<double> weight, depth;
  std::optional<int> across;
  bool fixed = false, published = false;
};

[[noreturn]] void refuseSkin(const std::string& option, const std::string& value,
                             const std::string& allowed) {
  throw InputError("command line", option, value, allowed);
}

int wholeNumber(const std::string& option, const std::string& all, const std::string& text) {
  const std::optional<double> value = parseNumber(text);
  if (!value || !(*value >= 1.0 && *value <= 1e6) || *value != static_cast<int>(*value)) {
    refuseSkin(option, all, "must be two whole numbers > 0, as 16x6");
  }
  return static_cast<int>(*value);
}

skin::TwoLayerBlock blockOf(const SkinOptions& options) {
  skin::TwoLayerBlock block = options.block;
  if (!options.mesh.empty()) {
    const std::size_t cross = options.mesh.find('x');
    if (cross == std::string::npos) refuseSkin("--mesh", options.mesh, "must be as 16x6");
    block.columns = wholeNumber("--mesh", options.mesh, options.mesh.substr(0, cross));
    block.rows = wholeNumber("--mesh", options.mesh, options.mesh.substr(cross + 1));
  }
  block.upper_rows = skin::upperRows(options.fraction, block.rows);
  block.idealization = skin::idealizationOf(options.variant);
  block.slides = !options.fixed;
  if (options.diagonals == "alternating") block.diagonals = skin::Diagonals::kAlternating;
  return block;
}

std::vector<double> ratiosOf(const std::string& text) {
  if (text == "none") return {};
  if (text == "geometric") return skin::geometricRatios();
  if (text == "linear") return skin::linearRatios();
  std::vector<double> ratios;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::optional<double> ratio = parseNumber(text.substr(begin, comma - begin));
    if (!ratio) refuseSkin("--ratios", text, "must be geometric, linear, none or numbers as 1,3,7");
    ratios.push_back(*ratio);
    begin = comma + 1;
  }
  return ratios;
}

void warnOf(const skin::UnitIndentation& unit, double depth, const std::string& what) {
  const double inverted = skin::inversionDepth(unit), bone = skin::boneDepth(unit);
  if (depth > inverted) {
    std::cout << "  warning: " << what << " a triangle is inverted, from " << 1e3 * inverted
              << " mm on\n";
  }
  if (depth > bone) {
    std::cout << "  warning: " << what << " a node is below the bone, from " << 1e3 * bone
              << " mm on\n";
  }
}

void printFit(const skin::UnitIndentation& unit, const std::string& name, double depth,
              const skin::ProfileErrors& errors) {
  std::cout << "  " << std::left << std::setw(17) << name << std::right << std::fixed
            << std::setprecision(4) << std::setw(9) << 1e3 * depth << std::setw(12)
            << std::setprecision(6) << 1e3 * errors.published << std::setprecision(4)
            << std::setw(9) << 1e3 * errors.rms << std::setw(9) << 1e3 * errors.largest
            << std::setw(11) << depth * unit.force << "\n"
            << std::defaultfloat << std::setprecision(6);
}

void printOptimum(const std::string& name, const skin::TwoLayerBlock& block,
                  const std::vector<skin::SweepPoint>& points, const skin::Criterion& criterion) {
  const skin::SweepPoint& best = skin::optimum(points, criterion);
  std::cout << "  least " << std::left << std::setw(11) << name << std::right
            << 1e3 * criterion(best) << " mm at " << best.upper_rows << "/" << block.rows
            << ", ratio " << best.stiffness_ratio << ": " << 1e3 * best.sets[0].errors.published
            << " and " << 1e3 * best.sets[1].errors.published << "; "
            << skin::acceptable(points, criterion, kAcceptable).size() << " of " << points.size()
            << " within " << 100 * (kAcceptable - 1.0) << " %\n";
}

void sweepAndReport(const SkinOptions& options, const skin::TwoLayerBlock& block,
                    const std::string& folder) {
  const std::vector<double> ratios = ratiosOf(options.ratios);
  if (ratios.empty()) return;
  const auto points =
      skin::sweep(block, ratios,
                  options.protocol == "published" ? skin::DepthProtocol::kPublished
                                                  : skin::DepthProtocol::kConverged);
  writeSweep(folder + "/sweep.csv", block, points);
  using Kind = skin::Criterion::Kind;
  printOptimum("larger", block, points, {Kind::kLargest});
  printOptimum("sum", block, points, {Kind::kSum});
  if (options.weight) printOptimum("weighted", block, points, {Kind::kWeighted, *options.weight});
}

int runPublished(const std::string& folder) {
  const std::vector<skin::PublishedFigure> figures = skin::publishedFigures();
  const std::string file = folder + "/published.csv";
  writePublished(file, figures);
  const auto agree = std::count_if(figures.begin(), figures.end(),
                                   [](const skin::PublishedFigure& f) { return f.agrees(); });
  std::cout << file << "\n  " << agree << " of " << figures.size()
            << " printed figures to the last digit\n";
  return agree == static_cast<std::ptrdiff_t>(figures.size()) ? kOk : kNotConverged;
}

double milliseconds(SkinClock::time_point from) {
  return std::chrono::duration<double, std::milli>(SkinClock::now() - from).count();
}

int report(const SkinOptions& options) {
  if (options.weight && !(*options.weight >= 0.0 && *options.weight <= 1.0)) {
    refuseSkin("--weight", formatNumber(*options.weight), "must be in [0, 1]");
  }
  if (options.depth && !std::isfinite(*options.depth)) {
    refuseSkin("--depth", formatNumber(*options.depth), "must be a finite number");
  }
  const skin::TwoLayerBlock block = blockOf(options);
  skin::checkBlock(block);
  const std::string folder = makeFolder(options.out).string();
  if (options.published) return runPublished(folder);
  const auto begin = SkinClock::now();
  const skin::UnitIndentation unit = skin::indent(block);
  const double solved = milliseconds(begin);
  std::cout << folder << "\n  block            " << unit.mesh.points.cols() << " nodes, "
            << unit.mesh.triangles.size() << " triangles, band " << unit.band_width
            << ", solved in " << solved << " ms, " << 1e-3 * unit.force << " N by mm of depth\n"
            << "                   depth    sqrt/n [mm]      rms      max   force [N]\n";
  std::vector<double> depths;
  for (int set = 1; set <= skin::kProfileSets; ++set) {
    const skin::MeasuredProfile& profile = skin::measuredProfile(set);
    depths.push_back(options.depth ? *options.depth : skin::pinnedDepth(unit, profile));
    const skin::ProfileErrors errors = skin::profileErrors(unit, depths.back(), profile);
    printFit(unit, "set " + std::to_string(set) + ", " + profile.name, depths.back(), errors);
    warnOf(unit, depths.back(), "at that depth");
  }
  writeProfiles(folder + "/profiles.csv", unit, depths);
  writeBlock(folder + "/nodes.csv", folder + "/triangles.csv", unit);
  if (options.across) {
    formats::writeVtu(folder + "/block.vtu", solidBlock(block, *options.across), {}, {});
  }
  sweepAndReport(options, block, folder);
  return kOk;
}

int runSkin(const SkinOptions& options) {
  try {
    return report(options);
  } catch (const std::domain_error& error) {
    std::cout << "  not solved: " << error.what() << "\n";
    return kNotConverged;
  }
}

}  // namespace

void addSkin(CLI::App& app, Action& action) {
  Command command(app, "skin",
                  "Press two layers of skin on bone, beside measured profiles of the surface");
  const auto options = std::make_shared<SkinOptions>();
  skin::TwoLayerBlock& block = options->block;
  command
      .option("--variant", &options->variant,
              "plane_stress_published (if not given), plane_stress, plane_strain or axisymmetric")
      .oneOf(skin::idealizationNames());
  command.option("--mesh", &options->mesh, "Squares across and down, 16x6 if not given");
  command.option("--diagonals", &options->diagonals, "one_way (if not given) or alternating")
      .oneOf({"one_way", "alternating"});
  command.option("--fraction", &options->fraction,
                 "Of the height that is the upper layer, 0.5 if not given");
  command.option("--ratio", &block.stiffness_ratio,
                 "Young's modulus of the upper over that of the lower layer, 10 if not given");
  command.option("--young-modulus", &block.young_modulus, "Of the upper layer [Pa], 0.2e6");
  command.option("--poisson-ratio", &block.poisson_ratio, "0.48 if not given");
  command.option("--width", &block.width, "[m], 0.012 if not given");
  command.option("--height", &block.height, "[m], 0.0045 if not given");
  command.option("--slab", &block.slab, "Across the plane, 0.001 if not given [m]");
  command.option("--patch", &block.patch,
                 "Half the width that is pressed [m]; one node if not given");
  command.flag("--fixed", &options->fixed, "What is pressed does not slide sideways");
  command.option("--depth", &options->depth,
                 "Of the contact [m]; if not given, the one that the readings need");
  command.option("--ratios", &options->ratios,
                 "Of the sweep: geometric (1 to 511, if not given), linear (7 to 15), none, or "
                 "numbers as 1,3,7");
  command
      .option("--protocol", &options->protocol,
              "Depths of the sweep: converged (if not given) or published, which corrects twice")
      .oneOf({"converged", "published"});
  command.option("--weight", &options->weight,
                 "Of set 1, for an optimum of the weighted errors too, in [0, 1]");
  command.option("--block", &options->across,
                 "Write the block in space too, with so many cells a side, as block.vtu");
  command.flag("--published", &options->published,
               "All 576 figures of Triantafyllopoulos (2005) instead, beside ours");
  command.option("--out", &options->out, "Folder for the tables").required();
  command.onUse([options, &action] { action = [options] { return runSkin(*options); }; });
}

}  // namespace palpate::cli
