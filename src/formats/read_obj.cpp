// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cursor.h"
#include "surface_builder.h"
#include "surface_formats.h"

namespace palpate::formats {
namespace {

/// A face, stored until all points are read.
struct Face {
  std::ptrdiff_t line;
  std::size_t end;  // end of its corners in the list of all corners
};

/// The next word of a line, which "\" at its end continues.
std::string_view wordOnLongLine(Cursor& in) {
  std::string_view word = in.wordOnLine();
  while (word == "\\") {
    in.skipLine();
    word = in.wordOnLine();
  }
  return word;
}

}  // namespace

mesh::SurfaceMesh readObj(const std::string& file, std::string_view bytes) {
  Syntax syntax;
  syntax.comment = '#';
  Cursor in(file, bytes, syntax);
  SurfaceBuilder builder(file);
  std::vector<Face> faces;
  std::vector<std::int64_t> corners;
  while (!in.atEnd()) {
    const std::string_view key = in.word();
    if (key == "v") {
      const double x = in.toNumber(wordOnLongLine(in), "x of a vertex");
      const double y = in.toNumber(wordOnLongLine(in), "y of a vertex");
      const double z = in.toNumber(wordOnLongLine(in), "z of a vertex");
      builder.addPoint(Vec3(x, y, z));
    } else if (key == "f") {
      const std::ptrdiff_t line = in.line();
      std::string_view word;
      while (!(word = wordOnLongLine(in)).empty()) {
        // v, v/vt, v//vn, v/vt/vn: the vertex is first.
        const std::int64_t index =
            in.toInteger(word.substr(0, word.find('/')), "vertex index of a face");
        if (index == 0) in.fail(word, "a vertex index must not be 0: they count from 1");
        const auto count = static_cast<std::int64_t>(builder.numPoints());
        corners.push_back(index > 0 ? index - 1 : count + index);
      }
      faces.push_back({line, corners.size()});
    }
    in.skipLine();
  }
  const auto end = static_cast<std::int64_t>(builder.numPoints());
  std::size_t begin = 0;
  for (const Face& face : faces) {
    const auto at = corners.begin();
    builder.addPolygon(
        {at + static_cast<std::ptrdiff_t>(begin), at + static_cast<std::ptrdiff_t>(face.end)}, 0,
        end, [&face] { return "line " + std::to_string(face.line); });
    begin = face.end;
  }
  return builder.finish();
}

}  // namespace palpate::formats
