// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "command.h"
#include "commands.h"
#include "options.h"
#include "palpate/springs/network_modes.h"
#include "palpate/springs/springs_file.h"
#include "palpate/springs/step_bound.h"
#include "springs_source.h"

namespace palpate::cli {
namespace {

constexpr Eigen::Index kMaxModesPoints = 400;  // more take many seconds

struct SpringsOptions {
  SpringsChoice choice;
  std::string out;
};

void printCounts(const MadeSprings& made) {
  std::map<springs::SpringKind, int> kinds;
  for (const springs::Spring& s : made.network.springs) ++kinds[s.kind];
  std::cout << "  points           " << made.network.points.cols() << ", "
            << made.network.masses.sum() << " kg\n"
            << "  springs          " << made.network.springs.size() << ":";
  for (const auto& [kind, count] : kinds) std::cout << " " << count << " " << toString(kind);
  std::cout << "\n";
  if (made.counts) {
    const springs::SheetCounts& c = *made.counts;
    std::cout << "  sheet            N_t " << c.triangles << ", N_v " << c.vertices << ", N_b "
              << c.boundary_vertices << ", N_3 " << c.valence_3 << ", N_4 " << c.valence_4
              << ", N_s " << c.springs << ", 3 N_t - 3 N_3 - 2 N_4 = " << c.expectedSprings()
              << "\n";
  }
}

void printResiduals(const MadeSprings& made) {
  for (const auto& [title, families] : made.residuals) {
    std::cout << "  " << std::left << std::setw(17) << title + " lacks"
              << "                rms      worst, of   mean scale\n";
    for (const springs::ConstraintFamily& family : families) {
      std::cout << "    " << std::left << std::setw(22) << family.name << std::right
                << std::setprecision(3) << std::setw(12) << family.rms << std::setw(11)
                << family.worst << std::setw(13) << family.scale << "\n";
    }
  }
  std::cout << std::setprecision(6);
}

void printSprings(const SpringsOptions& options, const MadeSprings& made) {
  std::cout << options.out << "\n";
  printCounts(made);
  printResiduals(made);
  if (!made.residuals.empty()) {
    std::cout << "  at a bound       " << made.slack << " without stiffness, " << made.bounded
              << " as stiff as the step allows\n";
  }
  std::cout << "  explicit step    stable up to " << 1e3 * springs::largestStep(made.network)
            << " ms\n";
  const springs::SpringNetwork& network = made.network;
  double largest = 0.0;
  for (const springs::Spring& s : network.springs) {
    largest = std::max(largest, std::abs(s.preload));
  }
  const double imbalance =
      springs::networkForces(network, network.points).colwise().norm().maxCoeff();
  const bool balanced = imbalance <= 1e-9 * largest;
  std::cout << "  out of balance   " << (balanced ? 0.0 : imbalance) << " N at the worst point"
            << (balanced ? "" : ": free edges contract") << "\n";
  if (balanced && network.points.cols() <= kMaxModesPoints) {
    const springs::NetworkModes modes = springs::networkModes(network);
    std::cout << "  free motions     " << modes.neutral << " without energy, " << modes.falling
              << " that lose energy\n";
  }
}

int runSprings(const SpringsOptions& options) {
  requireWritable("--out", options.out, {".csv"});
  const MadeSprings made = makeSprings(options.choice);
  springs::writeSprings(options.out, made.network);
  printSprings(options, made);
  return kOk;
}

}  // namespace

void addSprings(CLI::App& app, Action& action) {
  Command command(app, "springs",
                  "Give masses and springs the constants of a beam, sheet or solid");
  const auto options = std::make_shared<SpringsOptions>();
  SpringsChoice& choice = options->choice;
  command.option("mesh", &choice.mesh,
                 "A sheet of triangles (.obj, .off, .stl, .ply, .wrl) or tetrahedra (.msh, .vtk, "
                 ".vtu, .mesh)");
  command.option("--scale", &choice.scale,
                 "Metres in one unit of the file, 0.001 for millimetres; 1 if not given");
  command
      .option("--regular", &choice.regular,
              "A regular mesh in place of a file: line, squares, triangles or cubes")
      .oneOf({"line", "squares", "triangles", "cubes"});
  command.option("--cells", &choice.cells, "Its cells along each axis: N, N,N or N,N,N");
  command.option("--spacing", &choice.spacing, "Distance of its masses [m]");
  command.option("--diagonals", &choice.diagonals, "Of cubes: faces (if not given) or body")
      .oneOf({"faces", "body"});
  command.flag("--printed", &choice.printed,
               "Squares and cubes by the constants that Wang (2005) prints, not the right ones");
  command.option("--young-modulus", &choice.young_modulus, "[Pa]").required();
  command.option("--poisson-ratio", &choice.poisson_ratio, "Of sheets");
  command.option("--thickness", &choice.thickness, "Of sheets and lines [m]");
  command.option("--width", &choice.width, "Of lines [m]");
  command.option("--density", &choice.density, "[kg/m^3]").required();
  command.option(
      "--step", &choice.step,
      "No spring of a file is stiffer than an explicit step as long as this carries [s]");
  command.flag("--match-mean", &choice.match_mean,
               "Multiply what is fitted so that its mean is right: least squares are too soft");
  command.option("--out", &options->out, "File to write, .csv").required();
  command.onUse([options, &action] { action = [options] { return runSprings(*options); }; });
}

}  // namespace palpate::cli
