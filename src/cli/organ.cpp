// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <string>

#include "command.h"
#include "commands.h"
#include "options.h"
#include "palpate/base/error.h"
#include "palpate/formats/surface_io.h"
#include "palpate/organs/organs.h"

namespace palpate::cli {
namespace {

struct OrganOptions {
  std::string name;
  double edge_length = 0.0;
  std::string out;
};

int runOrgan(const OrganOptions& options) {
  requirePositive("--edge-length", options.edge_length);
  requireWritable("--out", options.out, {".obj", ".off"});
  const mesh::SurfaceMesh surface = organs::makeOrgan(options.name, options.edge_length);
  formats::writeSurface(options.out, surface);
  std::cout << options.out << ": " << surface.points.cols() << " points, "
            << surface.triangles.cols() << " triangles, " << 1.0e6 * mesh::enclosedVolume(surface)
            << " cm^3\n";
  return kOk;
}

}  // namespace

void addOrgan(CLI::App& app, Action& action) {
  Command command(app, "organ", "Make the surface of an organ");
  const auto options = std::make_shared<OrganOptions>();
  command.option("name", &options->name, "One of " + joinNames(organs::organNames())).required();
  command.option("--edge-length", &options->edge_length, "Mean edge of the triangles [m]")
      .required();
  command.option("--out", &options->out, "File to write, .off or .obj").required();
  command.onUse([options, &action] { action = [options] { return runOrgan(*options); }; });
}

}  // namespace palpate::cli
