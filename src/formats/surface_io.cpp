// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/formats/surface_io.h"

#include <locale>
#include <sstream>
#include <vector>

#include "file_bytes.h"
#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "surface_formats.h"

namespace palpate::formats {
namespace {

struct SurfaceFormat {
  const char* extension;
  mesh::SurfaceMesh (*read)(const std::string& file, std::string_view bytes);
};

// To add a format: write its reader, declare it in surface_formats.h, list it here.
constexpr SurfaceFormat kSurfaceFormats[] = {
    {".obj", readObj}, {".off", readOff}, {".ply", readPly}, {".stl", readStl}, {".wrl", readWrl}};

std::string offText(const mesh::SurfaceMesh& surface) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << "OFF\n" << surface.points.cols() << ' ' << surface.triangles.cols() << " 0\n";
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    const Vec3 p = surface.points.col(i);
    out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  for (Eigen::Index i = 0; i < surface.triangles.cols(); ++i) {
    const Eigen::Vector3i t = surface.triangles.col(i);
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }
  return out.str();
}

std::string objText(const mesh::SurfaceMesh& surface) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    const Vec3 p = surface.points.col(i);
    out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  for (Eigen::Index i = 0; i < surface.triangles.cols(); ++i) {
    const Eigen::Vector3i t = surface.triangles.col(i).array() + 1;
    out << "f " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }
  return out.str();
}

}  // namespace

mesh::SurfaceMesh parseSurface(const std::string& file, std::string_view bytes) {
  const std::string extension = lowerCaseExtension(file);
  std::vector<std::string> known;
  for (const SurfaceFormat& format : kSurfaceFormats) {
    if (extension == format.extension) return format.read(file, bytes);
    known.emplace_back(format.extension);
  }
  throw InputError(file, "extension", extension, "a surface must be one of " + joinNames(known));
}

mesh::SurfaceMesh readSurface(const std::string& file) {
  return parseSurface(file, readFileBytes(file));
}

void writeSurface(const std::string& file, const mesh::SurfaceMesh& surface) {
  const std::string extension = lowerCaseExtension(file);
  if (extension == ".off") return writeFileAtomically(file, offText(surface));
  if (extension == ".obj") return writeFileAtomically(file, objText(surface));
  throw InputError(file, "extension", extension, "a surface is written as .off or .obj");
}

}  // namespace palpate::formats
