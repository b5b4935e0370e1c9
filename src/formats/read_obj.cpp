// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <utility>
#include <vector>

#include "cursor.h"
#include "surface_builder.h"
#include "surface_formats.h"

namespace palpate::formats {
namespace {

/// The next word of a line that "\" at its end continues.
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
  std::vector<std::pair<std::string, std::vector<std::int64_t>>> faces;
  while (!in.atEnd()) {
    const std::string_view key = in.word();
    if (key == "v") {
      const double x = in.toNumber(wordOnLongLine(in), "x of a vertex");
      const double y = in.toNumber(wordOnLongLine(in), "y of a vertex");
      const double z = in.toNumber(wordOnLongLine(in), "z of a vertex");
      builder.addPoint(Vec3(x, y, z));
    } else if (key == "f") {
      faces.emplace_back(in.where(), std::vector<std::int64_t>());
      std::string_view word;
      while (!(word = wordOnLongLine(in)).empty()) {
        // v, v/vt, v//vn, v/vt/vn: the vertex comes first.
        const std::int64_t index =
            in.toInteger(word.substr(0, word.find('/')), "vertex index of a face");
        if (index == 0) in.fail(word, "a vertex index must not be 0: they count from 1");
        const auto count = static_cast<std::int64_t>(builder.numPoints());
        faces.back().second.push_back(index > 0 ? index - 1 : count + index);
      }
    }
    in.skipLine();
  }
  const auto end = static_cast<std::int64_t>(builder.numPoints());
  for (const auto& [where, corners] : faces) {
    builder.addPolygon(corners, 0, end, [&where = where] { return where; });
  }
  return builder.finish();
}

}  // namespace palpate::formats
