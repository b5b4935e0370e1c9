// SPDX-License-Identifier: GPL-3.0-or-later
#include "anatomy_assembly.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/contact/touch_balls.h"
#include "palpate/formats/surface_io.h"
#include "palpate/mesh/size_check.h"

namespace palpate::scene {
namespace {

constexpr double kWorthAWarning = 1.0e-4;  // reported depth [m]

// Largest bounding radius of the tools' shapes [m].
double largestBall(const SceneParts& parts) {
  double largest = 0.0;
  for (const instrument::Instrument& tool : parts.instruments) {
    for (const instrument::CollisionBody& body : tool.bodies()) {
      for (const contact::TouchBall& ball : contact::touchBalls(body.geometry)) {
        largest = std::max(largest, ball.radius);
      }
    }
  }
  return largest;
}

AnatomyPart readPart(const Scene& scene, const AnatomyConfig& config, const std::string& key,
                     const Progress& progress, SceneParts* parts) {
  const auto report = [&](const std::string& stage, double part) {
    if (progress) progress("anatomy " + config.name + ": " + stage, part);
  };
  try {
    const std::string file =
        resolveResource(config.surface, std::filesystem::path(scene.file).parent_path().string());
    mesh::SurfaceMesh surface = formats::readSurface(file);
    surface.points *= config.scale;
    mesh::checkSize(surface.points, scene.file, key + ".scale");
    // Centred, so that a bounding sphere rejects distant points quickly.
    const Vec3 middle =
        0.5 * (surface.points.rowwise().minCoeff() + surface.points.rowwise().maxCoeff());
    surface.points.colwise() -= middle;
    instrument::MeshShapeSettings settings = config.shape;
    settings.margin = largestBall(*parts);
    instrument::MeshShape shape = instrument::shapeOfMesh(surface, file, settings, report);
    for (const std::string& repair : shape.repairs) parts->warnings.push_back(file + ": " + repair);
    if (!shape.note.empty()) parts->notes.push_back("anatomy " + config.name + ": " + shape.note);
    return {config.name, std::move(shape.geometry),
            config.pose.pose() * Eigen::Translation3d(middle), config.felt_stiffness,
            std::move(surface)};
  } catch (const std::invalid_argument& error) {
    throw InputError(scene.file, key + ".surface", config.surface, error.what());
  }
}

}  // namespace

void assembleAnatomy(const Scene& scene, const Progress& progress, SceneParts* parts) {
  for (std::size_t i = 0; i < scene.anatomy.size(); ++i) {
    const std::string key = "anatomy[" + std::to_string(i) + "]";
    parts->anatomy.push_back(readPart(scene, scene.anatomy[i], key, progress, parts));
  }
}

void warnOfOrgansInAnatomy(const Scene& scene, SceneParts* parts) {
  for (std::size_t i = 0; i < parts->organs.size(); ++i) {
    const Points& x = parts->organs[i].surfaceState().positions;
    for (const AnatomyPart& part : parts->anatomy) {
      const Pose X_GW = part.X_WG.inverse();
      double depth = 0.0;
      for (Eigen::Index n = 0; n < x.cols(); ++n) {
        depth = std::max(depth, -contact::signedDistanceValue(part.geometry, X_GW * x.col(n)));
      }
      if (depth < kWorthAWarning) continue;
      std::ostringstream text;
      text.precision(2);
      text << "organ " << scene.organs[i].name << " begins " << 1e3 * depth
           << " mm deep in anatomy " << part.name << ", which will push it out";
      parts->warnings.push_back(text.str());
    }
  }
}

}  // namespace palpate::scene
