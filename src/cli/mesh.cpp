// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>

#include "command.h"
#include "commands.h"
#include "options.h"
#include "palpate/formats/surface_io.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/mesh/quality.h"
#include "palpate/mesh/size_check.h"
#include "palpate/mesh/surface_check.h"
#include "palpate/mesh/volume_mesher.h"
#include "progress_line.h"

namespace palpate::cli {
namespace {

struct Options {
  std::string surface, out;
  double edge_length = 0.0;
  double scale = 1.0;
  bool no_cache = false;
};

struct Meshed {
  mesh::SurfaceReport repairs;
  mesh::TetMesh mesh;
  mesh::TetQuality quality;
  double seconds = 0.0;  // wall time of meshing alone
  bool from_cache = false;
};

Meshed meshSurface(const Options& options) {
  start::ProgressLine line;
  const mesh::MeshingProgress progress = [&](const std::string& stage, double fraction) {
    line.show(stage, fraction);
  };
  Meshed result;
  line.show("reading " + options.surface, 0.0);
  mesh::SurfaceMesh surface = formats::readSurface(options.surface);
  surface.points *= options.scale;
  mesh::checkSize(surface.points, options.surface, "--scale");
  line.show("checking the surface", 0.0);
  surface = mesh::repairSurface(surface, options.surface, &result.repairs);

  mesh::MeshingOptions meshing;
  meshing.edge_length.coarsest = options.edge_length;
  meshing.file = options.surface;
  const std::string cache = options.no_cache ? "" : mesh::defaultCacheDirectory();
  const auto start = std::chrono::steady_clock::now();
  result.mesh = mesh::meshVolumeCached(surface, meshing, cache, progress, &result.from_cache);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.quality = mesh::measureQuality(result.mesh, &surface);
  return result;
}

void printReport(const Options& options, const Meshed& result) {
  const mesh::TetQuality& quality = result.quality;
  std::cout << options.out << "\n" << std::fixed << std::setprecision(2);
  if (result.repairs.repairs.empty()) std::cout << "  surface          nothing to repair\n";
  for (const std::string& repair : result.repairs.repairs) {
    std::cout << "  repaired         " << repair << "\n";
  }
  std::cout << "  nodes            " << result.mesh.numPoints() << "\n"
            << "  tetrahedra       " << result.mesh.numTets() << "\n"
            << "  mean edge        " << 1e3 * quality.mean_edge_length << " mm\n"
            << "  dihedral angle   min " << quality.min_dihedral_deg << ", median "
            << quality.median_dihedral_deg << " degrees\n"
            << "  radius/edge      worst " << quality.worst_radius_edge_ratio << "\n"
            << "  volume           " << 1e6 * quality.volume << " cm^3, "
            << 100.0 * quality.volume_error << " % from the surface's\n"
            << "  meshing took     " << result.seconds << " s"
            << (result.from_cache ? " (from the cache)" : "") << "\n";
}

int run(const Options& options) {
  requirePositive("--edge-length", options.edge_length);
  requirePositive("--scale", options.scale);
  requireWritable("--out", options.out, {".vtu"});
  const Meshed result = meshSurface(options);
  formats::writeVtu(options.out, result.mesh, {}, {});
  printReport(options, result);
  return kOk;
}

}  // namespace

void addMesh(CLI::App& app, Action& action) {
  Command command(app, "mesh", "Fill a closed surface with tetrahedra");
  const auto options = std::make_shared<Options>();
  command.option("surface", &options->surface, "File: .obj, .off, .stl, .ply or .wrl").required();
  command
      .option("--edge-length", &options->edge_length,
              "Mean edge of the tetrahedra [m], after scaling")
      .required();
  command.option("--out", &options->out, "File to write, .vtu").required();
  command.option("--scale", &options->scale,
                 "Metres in one unit of the file, 0.001 for millimetres; 1 if not given");
  command.flag("--no-cache", &options->no_cache,
               "Mesh anew and remember nothing, whatever is in the cache");
  command.onUse([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace palpate::cli
