// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "cursor.h"
#include "scalar_type.h"
#include "surface_builder.h"
#include "surface_formats.h"

namespace palpate::formats {
namespace {

struct Property {
  std::string name;
  ScalarType type;
  bool is_list = false;
  ScalarType count_type;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kText, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
};

ScalarType typeNamed(std::string_view name, Cursor& in) {
  const auto type = plyType(name);
  if (!type) in.fail(name, "must be a PLY type: char, uchar, short, ushort, int, uint, float, ...");
  return *type;
}

Property readProperty(Cursor& in) {
  Property property;
  std::string_view word = in.wordOnLine();
  property.is_list = word == "list";
  if (property.is_list) {
    property.count_type = typeNamed(in.wordOnLine(), in);
    word = in.wordOnLine();
  }
  property.type = typeNamed(word, in);
  property.name = in.wordOnLine();
  return property;
}

Encoding readEncoding(Cursor& in) {
  const std::string_view word = in.wordOnLine();
  if (word == "ascii") return Encoding::kText;
  if (word == "binary_little_endian") return Encoding::kLittleEndian;
  if (word == "binary_big_endian") return Encoding::kBigEndian;
  in.fail(word, "must be ascii, binary_little_endian or binary_big_endian");
}

Header readHeader(Cursor& in) {
  Header header;
  in.expect("ply");
  bool has_format = false;
  for (;;) {
    const std::string_view key = in.word();
    if (key == "format") {
      header.encoding = readEncoding(in);
      has_format = true;
    } else if (key == "element") {
      Element element;
      element.name = in.wordOnLine();
      element.count = in.toInteger(in.wordOnLine(), "number of elements");
      in.checkCount(element.count, "number of elements", 1);
      header.elements.push_back(element);
    } else if (key == "property") {
      if (header.elements.empty()) in.fail(key, "an element must come first");
      header.elements.back().properties.push_back(readProperty(in));
    } else if (key == "end_header") {
      in.skipLine();
      break;
    } else if (key != "comment" && key != "obj_info") {
      in.fail(key, key.empty() ? "truncated: the header has no end"
                               : "must be format, element, property, comment or end_header");
    }
    in.skipLine();
  }
  if (!has_format) in.fail("", "the header must have a format line");
  return header;
}

/// Reads the values of the data part one by one.
class Values {
 public:
  Values(Cursor& in, Encoding encoding)
      : in_(in),
        text_(encoding == Encoding::kText),
        swap_((encoding == Encoding::kLittleEndian) != hostIsLittleEndian()) {}

  double next(ScalarType type, const char* what) {
    if (text_) return in_.number(what);
    return loadNumber(in_.bytes(type.size, what).data(), type, swap_);
  }
  std::int64_t nextCount(const Property& list) {
    const double n = next(list.count_type, "length of a list");
    if (!(n >= 0.0 && n < 4e9 && n == std::floor(n))) {
      in_.fail(std::to_string(n), "must be the length of a list");
    }
    in_.checkCount(static_cast<std::int64_t>(n), "length of a list", text_ ? 2 : list.type.size);
    return static_cast<std::int64_t>(n);
  }

 private:
  Cursor& in_;
  bool text_, swap_;
};

bool isCorners(const Property& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void readVertex(const Element& element, Values& values, SurfaceBuilder* builder) {
  Vec3 point = Vec3::Zero();
  for (const Property& property : element.properties) {
    std::int64_t n = property.is_list ? values.nextCount(property) : 1;
    for (; n > 0; --n) {
      const double value = values.next(property.type, "property of a vertex");
      for (int k = 0; k < 3; ++k) {
        if (!property.is_list && property.name == std::string(1, "xyz"[k])) point[k] = value;
      }
    }
  }
  builder->addPoint(point);
}

/// Reads any element but a vertex; for a face, its corners.
void readOther(const Element& element, Values& values, std::vector<std::int64_t>* corners) {
  for (const Property& property : element.properties) {
    std::int64_t n = property.is_list ? values.nextCount(property) : 1;
    const bool is_corners = isCorners(property);
    if (is_corners) corners->clear();
    for (; n > 0; --n) {
      const double value = values.next(property.type, "property of a face");
      const bool is_index = value >= 0.0 && value < 4e9 && value == std::floor(value);
      if (is_corners) corners->push_back(is_index ? std::int64_t(value) : -1);
    }
  }
}

const Element& elementNamed(const char* name, const Header& header, const Cursor& in) {
  for (const Element& element : header.elements) {
    if (element.name == name) return element;
  }
  in.fail("", std::string("the header must have an element '") + name + "'");
}

void checkHeader(const Header& header, const Cursor& in) {
  for (const char* axis : {"x", "y", "z"}) {
    const auto& properties = elementNamed("vertex", header, in).properties;
    if (std::none_of(properties.begin(), properties.end(),
                     [&](const Property& p) { return !p.is_list && p.name == axis; })) {
      in.fail("", std::string("element vertex must have a property '") + axis + "'");
    }
  }
  const auto& properties = elementNamed("face", header, in).properties;
  if (std::none_of(properties.begin(), properties.end(), isCorners)) {
    in.fail("", "element face must have a list property 'vertex_indices' or 'vertex_index'");
  }
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.count > 0) {
      in.fail(element.name, "an element must have a property");
    }
  }
}

}  // namespace

mesh::SurfaceMesh readPly(const std::string& file, std::string_view bytes) {
  Cursor in(file, bytes);
  const Header header = readHeader(in);
  checkHeader(header, in);
  const std::int64_t num_points = elementNamed("vertex", header, in).count;
  Values values(in, header.encoding);
  SurfaceBuilder builder(file);
  std::vector<std::int64_t> corners;
  for (const Element& element : header.elements) {
    for (std::int64_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        readVertex(element, values, &builder);
        continue;
      }
      readOther(element, values, &corners);
      if (element.name != "face") continue;
      builder.addPolygon(corners, 0, num_points, [&] { return "face " + std::to_string(i + 1); });
    }
  }
  return builder.finish();
}

}  // namespace palpate::formats
