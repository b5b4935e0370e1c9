// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/formats/tet_io.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "file_bytes.h"
#include "palpate/base/error.h"
#include "tet_formats.h"

namespace palpate::formats {
namespace {

struct TetFormat {
  const char* extension;
  mesh::TetMesh (*read)(const std::string& file, std::string_view bytes);
};

// To add a format: write its reader, declare it in tet_formats.h, list it here.
constexpr TetFormat kTetFormats[] = {
    {".mesh", readMedit}, {".msh", readMsh}, {".vtk", readVtk}, {".vtu", readVtu}};

constexpr double kDegenerate = 1e-12;  // least |V| over the longest edge cubed

double longestEdge(const Points& points, const Eigen::Vector4i& t) {
  double longest = 0.0;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) {
      longest = std::max(longest, (points.col(t[a]) - points.col(t[b])).norm());
    }
  }
  return longest;
}

/// Counts bad tetrahedra of one kind.
struct Tally {
  Eigen::Index count = 0, first = 0;
  void add(Eigen::Index i) {
    if (count++ == 0) first = i;
  }
  std::string text(Eigen::Index total) const {
    return std::to_string(count) + " of " + std::to_string(total) + ", the first is number " +
           std::to_string(first + 1);
  }
};

}  // namespace

void checkTets(const mesh::TetMesh& mesh, const std::string& file) {
  Tally inverted, flat;
  for (Eigen::Index i = 0; i < mesh.numTets(); ++i) {
    const double volume = mesh::signedVolume(mesh.points, mesh.tets.col(i));
    const double edge = longestEdge(mesh.points, mesh.tets.col(i));
    if (!(std::abs(volume) > kDegenerate * edge * edge * edge)) {  // NaN counts as degenerate
      flat.add(i);
    } else if (volume < 0.0) {
      inverted.add(i);
    }
  }
  std::vector<Problem> problems;
  if (inverted.count > 0) {
    problems.push_back({"inverted tetrahedra", inverted.text(mesh.numTets()),
                        "the volume must be positive, (b - a) x (c - a) . (d - a) > 0"});
  }
  if (flat.count > 0) {
    problems.push_back({"tetrahedra without volume", flat.text(mesh.numTets()),
                        "the volume must be more than 1e-12 of the longest edge cubed"});
  }
  if (!problems.empty()) throw InputError(file, problems);
}

mesh::TetMesh parseTetMesh(const std::string& file, std::string_view bytes) {
  const std::string extension = lowerCaseExtension(file);
  std::vector<std::string> known;
  for (const TetFormat& format : kTetFormats) {
    if (extension == format.extension) return format.read(file, bytes);
    known.emplace_back(format.extension);
  }
  throw InputError(file, "extension", extension,
                   "a tetrahedral mesh must be one of " + joinNames(known));
}

mesh::TetMesh readTetMesh(const std::string& file) {
  return parseTetMesh(file, readFileBytes(file));
}

}  // namespace palpate::formats
