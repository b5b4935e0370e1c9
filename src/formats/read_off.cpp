// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <vector>

#include "cursor.h"
#include "surface_builder.h"
#include "surface_formats.h"

namespace palpate::formats {
namespace {

/// "OFF" with any of the prefixes ST (texture), C (colour), N (normal), whose values follow x y z.
/// 4OFF and nOFF have other coordinates.
bool isOffHeader(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.substr(0, prefix.size()) == prefix) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

}  // namespace

mesh::SurfaceMesh readOff(const std::string& file, std::string_view bytes) {
  Syntax syntax;
  syntax.comment = '#';
  Cursor in(file, bytes, syntax);
  const std::string_view header = in.word();
  if (!isOffHeader(header)) {
    in.fail(header, "must begin with OFF, COFF, NOFF, STOFF or a mixture of them");
  }
  if (in.peek() == "BINARY") in.fail("BINARY", "binary OFF is not read; write it as text");
  const std::size_t num_points = in.count("number of vertices", 6);
  const std::size_t num_faces = in.count("number of faces", 2);
  in.integer("number of edges");
  in.skipLine();

  SurfaceBuilder builder(file);
  for (std::size_t i = 0; i < num_points; ++i) {
    const double x = in.number("x of a vertex");
    const double y = in.toNumber(in.wordOnLine(), "y of a vertex");
    const double z = in.toNumber(in.wordOnLine(), "z of a vertex");
    in.skipLine();
    builder.addPoint(Vec3(x, y, z));
  }
  std::vector<std::int64_t> corners;
  for (std::size_t i = 0; i < num_faces; ++i) {
    corners.resize(in.count("number of corners of a face", 2));
    const std::string where = in.where();
    for (std::int64_t& corner : corners) {
      corner = in.toInteger(in.wordOnLine(), "vertex index of a face");
    }
    in.skipLine();
    builder.addPolygon(corners, 0, static_cast<std::int64_t>(num_points), [&] { return where; });
  }
  return builder.finish();
}

}  // namespace palpate::formats
