// SPDX-License-Identifier: GPL-3.0-or-later
#include "collision_shapes.h"

#include <algorithm>
#include <exception>
#include <filesystem>

#include "palpate/base/resource.h"
#include "palpate/formats/surface_io.h"
#include "palpate/instrument/mesh_shape.h"

namespace palpate::instrument {
namespace {

Pose toPose(const urdf::Pose& urdf) {
  Pose X = Pose::Identity();
  X.linear() =
      Eigen::Quaterniond(urdf.rotation.w, urdf.rotation.x, urdf.rotation.y, urdf.rotation.z)
          .normalized()
          .toRotationMatrix();
  X.translation() = Vec3(urdf.position.x, urdf.position.y, urdf.position.z);
  return X;
}

Geometry shapeOf(const urdf::Mesh& urdf, const std::string& name, const std::string& folder,
                 const InstrumentOptions& options, Shapes* shapes) {
  const std::string file = resolveResource(urdf.filename, folder);
  mesh::SurfaceMesh surface = formats::readSurface(file);
  const Vec3 scale(urdf.scale.x, urdf.scale.y, urdf.scale.z);
  surface.points = scale.asDiagonal() * surface.points;
  // A mirroring scale reverses the orientation.
  if (scale.prod() < 0.0) surface.triangles.row(1).swap(surface.triangles.row(2));
  MeshShape shape =
      shapeOfMesh(surface, file, options.collision_meshes, [&](const auto& stage, double part) {
        if (options.progress) options.progress("collision mesh of " + name + ": " + stage, part);
      });
  for (const std::string& repair : shape.repairs) shapes->warnings.push_back(file + ": " + repair);
  if (!shape.note.empty()) shapes->notes.push_back("collision mesh of " + name + ": " + shape.note);
  return std::move(shape.geometry);
}

Geometry toGeometry(const urdf::Geometry& urdf, const std::string& name, const std::string& folder,
                    const InstrumentOptions& options, Shapes* shapes) {
  switch (urdf.type) {
    case urdf::Geometry::SPHERE:
      return Sphere{static_cast<const urdf::Sphere&>(urdf).radius};
    case urdf::Geometry::BOX: {
      const urdf::Vector3& size = static_cast<const urdf::Box&>(urdf).dim;
      return Box{0.5 * Vec3(size.x, size.y, size.z)};
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(urdf);
      if (!options.cylinder_as_capsule) return Cylinder{cylinder.radius, 0.5 * cylinder.length};
      return Capsule{cylinder.radius, std::max(0.0, 0.5 * cylinder.length - cylinder.radius)};
    }
    case urdf::Geometry::MESH:
      return shapeOf(static_cast<const urdf::Mesh&>(urdf), name, folder, options, shapes);
  }
  throw std::invalid_argument("the shape is of no known kind");
}

/// Mesh file for reports; "" for other shapes.
std::string meshName(const urdf::Geometry& urdf) {
  return urdf.type == urdf::Geometry::MESH ? static_cast<const urdf::Mesh&>(urdf).filename : "";
}

void readCollisions(const urdf::Link& link, int index, const std::string& folder,
                    const InstrumentOptions& options, Shapes* shapes) {
  for (const auto& collision : link.collision_array) {
    const std::string name =
        collision->name.empty() ? link.name : link.name + "/" + collision->name;
    const urdf::Geometry& geometry = *collision->geometry;
    if (geometry.type == urdf::Geometry::CYLINDER && options.cylinder_as_capsule) {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      if (cylinder.length < 2.0 * cylinder.radius) {
        shapes->warnings.push_back(
            "collision cylinder of " + name +
            " is shorter than thick; its capsule is a ball, which is longer");
      }
    }
    try {
      shapes->bodies.push_back({index, name, toPose(collision->origin),
                                toGeometry(geometry, name, folder, options, shapes)});
    } catch (const std::exception& error) {
      shapes->problems.push_back({"link " + link.name + "/collision",
                                  "'" + meshName(geometry) + "'",
                                  std::string("has no shape: ") + error.what()});
    }
  }
}

void lookForVisuals(const urdf::Link& link, const std::string& folder, Shapes* shapes) {
  for (const auto& visual : link.visual_array) {
    const std::string name = meshName(*visual->geometry);
    if (name.empty()) continue;
    std::string reason;
    try {
      std::error_code ignored;
      if (std::filesystem::is_regular_file(resolveResource(name, folder), ignored)) continue;
      reason = "no such file";
    } catch (const std::invalid_argument& error) {
      reason = error.what();
    }
    shapes->warnings.push_back("visual mesh '" + name + "' of link " + link.name +
                               " is missing: " + reason);
  }
}

}  // namespace

Shapes readShapes(const urdf::ModelInterface& model, const std::vector<std::string>& links,
                  const std::string& folder, const InstrumentOptions& options) {
  Shapes shapes;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const urdf::Link& link = *model.getLink(links[i]);
    readCollisions(link, static_cast<int>(i), folder, options, &shapes);
    lookForVisuals(link, folder, &shapes);
  }
  return shapes;
}

}  // namespace palpate::instrument
