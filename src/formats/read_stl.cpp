// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <vector>

#include "cursor.h"
#include "file_bytes.h"
#include "scalar_type.h"
#include "surface_builder.h"
#include "surface_formats.h"

namespace palpate::formats {
namespace {

constexpr std::size_t kHeader = 84, kFacet = 50;  // [bytes]

/// Adds each corner as a separate point; the builder merges equal ones.
std::int64_t addCorner(const Vec3& p, SurfaceBuilder* builder) {
  builder->addPoint(p + Vec3::Zero());  // converts negative zero, an equal point
  return static_cast<std::int64_t>(builder->numPoints()) - 1;
}

void addFacet(const std::vector<std::int64_t>& corners, const Cursor& in, SurfaceBuilder* builder) {
  builder->addPolygon(corners, 0, static_cast<std::int64_t>(builder->numPoints()),
                      [&] { return in.where(); });
}

mesh::SurfaceMesh readText(const std::string& file, std::string_view bytes) {
  Cursor in(file, bytes);
  SurfaceBuilder builder(file);
  std::vector<std::int64_t> corners;
  bool open = false;  // between solid and endsolid
  while (!in.atEnd()) {
    const std::string_view word = in.word();
    const std::string key = lowerCase(word);
    const bool in_loop = key == "vertex" || key == "endloop";
    if (!corners.empty() && !in_loop) in.fail(word, "must be 'endloop'");
    if (key == "solid" || key == "endsolid") {
      open = key == "solid";
      in.skipLine();  // name
    } else if (key == "facet") {
      in.skipLine();  // normal; the corner order defines the orientation
    } else if (key == "vertex") {
      const double x = in.number("x of a vertex");
      const double y = in.number("y of a vertex");
      const double z = in.number("z of a vertex");
      corners.push_back(addCorner(Vec3(x, y, z), &builder));
    } else if (key == "endloop") {
      addFacet(corners, in, &builder);
      corners.clear();
    } else if (key != "outer" && key != "loop" && key != "endfacet") {
      in.fail(word, "must be one of solid, facet, outer loop, vertex, endloop, endfacet, endsolid");
    }
  }
  if (open) in.fail("", "truncated: 'endsolid' must follow");
  builder.mergePoints();
  return builder.finish();
}

mesh::SurfaceMesh readBinary(const std::string& file, std::string_view bytes) {
  Cursor in(file, bytes);
  const bool swap = !hostIsLittleEndian();
  in.bytes(kHeader - 4, "the header of a binary STL file");
  const std::string_view number = in.bytes(4, "the number of facets");
  const auto num_facets = load<std::uint32_t>(number.data(), swap);
  if (num_facets > in.remaining() / kFacet) {
    in.fail(std::to_string(num_facets) + " facets", "truncated, or no STL file: only " +
                                                        std::to_string(in.remaining()) +
                                                        " bytes follow, a facet has 50");
  }
  SurfaceBuilder builder(file);
  std::vector<std::int64_t> corners(3);
  for (std::uint32_t i = 0; i < num_facets; ++i) {
    const char* facet = in.bytes(kFacet, "a facet").data();
    for (int c = 0; c < 3; ++c) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) {
        p[k] = static_cast<double>(load<float>(facet + 12 + 12 * c + 4 * k, swap));
      }
      if (!p.allFinite()) in.fail("", "the coordinates of a facet must be finite");
      corners[c] = addCorner(p, &builder);
    }
    addFacet(corners, in, &builder);
  }
  builder.mergePoints();
  return builder.finish();
}

/// Text or binary: many binary files begin with "solid", too. The size by the number of facets
/// decides, then whether the beginning is text.
bool isText(std::string_view bytes) {
  if (bytes.size() >= kHeader) {
    const auto n = load<std::uint32_t>(bytes.data() + kHeader - 4, !hostIsLittleEndian());
    if (bytes.size() == kHeader + kFacet * static_cast<std::uint64_t>(n)) return false;
  }
  const std::string_view head = bytes.substr(0, 1024);
  const bool has_controls = std::any_of(head.begin(), head.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && !(c >= '\t' && c <= '\r');
  });
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return !has_controls && first != std::string_view::npos &&
         lowerCase(head.substr(first, 5)) == "solid";
}

}  // namespace

mesh::SurfaceMesh readStl(const std::string& file, std::string_view bytes) {
  return isText(bytes) ? readText(file, bytes) : readBinary(file, bytes);
}

}  // namespace palpate::formats
