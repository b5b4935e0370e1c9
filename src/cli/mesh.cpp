// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include "command.h"
#include "commands.h"
#include "mesh_source.h"
#include "options.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/mesh/edge_lengths.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/mesh/quality.h"
#include "progress_line.h"

namespace palpate::cli {
namespace {

struct MeshOptions {
  MeshChoice choice;
  std::string out;
  bool no_cache = false;
};

struct Meshed {
  std::vector<std::string> repairs;
  mesh::TetMesh mesh;
  mesh::TetQuality quality;
  double seconds = 0.0;  // wall time of meshing alone
  bool from_cache = false;
};

Meshed meshSurface(const MeshOptions& options) {
  start::ProgressLine line;
  const mesh::MeshingProgress progress = [&](const std::string& stage, double fraction) {
    line.show(stage, fraction);
  };
  Meshed result;
  const MeshChoice& choice = options.choice;
  line.show("reading and checking " + (choice.scene.empty() ? choice.surface : choice.scene), 0.0);
  const MeshSource source = readMeshSource(choice);
  result.repairs = source.repairs;
  const std::string cache = options.no_cache ? "" : mesh::defaultCacheDirectory();
  const auto start = std::chrono::steady_clock::now();
  result.mesh =
      mesh::meshVolumeCached(source.surface, source.meshing, cache, progress, &result.from_cache);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.quality = mesh::measureQuality(result.mesh, &source.surface);
  return result;
}

// "1 to 1.5 mm", and how many of all edges are as long.
std::string edgeTable(const mesh::EdgeLengths& edges) {
  int all = 0;
  for (const mesh::EdgeClass& c : edges.classes) all += c.edges;
  std::ostringstream text;
  for (const mesh::EdgeClass& c : edges.classes) {
    std::ostringstream range;
    range << 1e3 * c.from << " to " << 1e3 * c.to << " mm";
    const double percent = 100.0 * c.edges / all;
    text << "    " << std::left << std::setw(15) << range.str() << std::right << std::setw(9)
         << c.edges << std::fixed << std::setprecision(1) << std::setw(7) << percent << " %  "
         << std::string(static_cast<std::size_t>(std::lround(0.5 * percent)), '#') << "\n";
  }
  return text.str();
}

void printReport(const MeshOptions& options, const Meshed& result) {
  const mesh::TetQuality& quality = result.quality;
  const mesh::EdgeLengths edges = mesh::measureEdges(mesh::cellsOf(result.mesh));
  std::cout << options.out << "\n" << std::fixed << std::setprecision(2);
  if (result.repairs.empty()) std::cout << "  surface          nothing to repair\n";
  for (const std::string& repair : result.repairs) {
    std::cout << "  repaired         " << repair << "\n";
  }
  std::cout << "  nodes            " << result.mesh.numPoints() << "\n"
            << "  tetrahedra       " << result.mesh.numTets() << "\n"
            << "  mean edge        " << 1e3 * edges.mean << " mm, least " << 1e3 * edges.least
            << ", largest " << 1e3 * edges.largest << "\n"
            << edgeTable(edges) << "  dihedral angle   min " << quality.min_dihedral_deg
            << ", median " << quality.median_dihedral_deg << " degrees\n"
            << "  radius/edge      worst " << quality.worst_radius_edge_ratio << "\n"
            << "  volume           " << 1e6 * quality.volume << " cm^3, "
            << 100.0 * quality.volume_error << " % from the surface's\n"
            << "  meshing took     " << result.seconds << " s"
            << (result.from_cache ? " (from the cache)" : "") << "\n";
}

int runMesh(const MeshOptions& options) {
  checkChoice(options.choice);
  requireWritable("--out", options.out, {".vtu"});
  const Meshed result = meshSurface(options);
  formats::writeVtu(options.out, result.mesh, {}, {});
  printReport(options, result);
  return kOk;
}

}  // namespace

void addMesh(CLI::App& app, Action& action) {
  Command command(app, "mesh", "Fill a closed surface with tetrahedra");
  const auto options = std::make_shared<MeshOptions>();
  MeshChoice& choice = options->choice;
  command.option("surface", &choice.surface, "File: .obj, .off, .stl, .ply or .wrl");
  command.option("--edge-length", &choice.edge_length,
                 "Mean edge of the tetrahedra [m], after scaling; with --near the coarsest");
  command.option("--scale", &choice.scale,
                 "Metres in one unit of the file, 0.001 for millimetres; 1 if not given");
  command.option("--near", &choice.near,
                 "X,Y,Z: a point with edges of --finest about it [m]; may be given several times");
  command.option("--finest", &choice.finest, "Mean edge there [m]");
  command.option("--radius", &choice.radius, "As far from there edges do not grow yet [m]");
  command.option("--growth", &choice.growth,
                 "Beyond it they grow by so much a metre, up to --edge-length; in (0, 1]");
  command.option("--scene", &choice.scene,
                 "Mesh an organ as this scene file, or shipped scene, says");
  command.option("--organ", &choice.organ, "Its name, where the scene has several");
  command.option("--out", &options->out, "File to write, .vtu").required();
  command.flag("--no-cache", &options->no_cache,
               "Mesh anew and remember nothing, whatever is in the cache");
  command.onUse([options, &action] { action = [options] { return runMesh(*options); }; });
}

}  // namespace palpate::cli
