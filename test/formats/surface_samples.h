// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "formats/sample.h"

namespace palpate::formats {

/// The tetrahedron 000 100 010 001, outward, in this order of points and triangles.
inline const double kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline std::string objSample() {
  return "# comment\nmtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
         "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

inline std::string offSample() {
  return "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

inline std::string stlTextSample() {
  std::string text = "solid tetrahedron\n";
  for (const auto& face : kFaces) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const int c : face) {
      text += "      vertex";
      for (const double x : kCorners[c]) text += ' ' + std::to_string(x);
      text += '\n';
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

inline std::string stlBinarySample(const std::string& title = "made by a test") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  put(&bytes, 4U);
  for (const auto& face : kFaces) {
    for (int i = 0; i < 3; ++i) put(&bytes, 0.0F);
    for (const int c : face) {
      for (const double x : kCorners[c]) put(&bytes, static_cast<float>(x));
    }
    put(&bytes, static_cast<unsigned short>(0));
  }
  return bytes;
}

inline std::string plyHeader(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment made by a test\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property double z\nproperty uchar red\nelement face 4\n"
         "property list uchar int vertex_indices\nend_header\n";
}

inline std::string plyTextSample() {
  return plyHeader("ascii") +
         "0 0 0 255\n1 0 0 255\n0 1 0 255\n0 0 1 255\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

inline std::string plyBinarySample(bool big_endian) {
  std::string bytes = plyHeader(big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const auto& corner : kCorners) {
    put(&bytes, static_cast<float>(corner[0]), big_endian);
    put(&bytes, static_cast<float>(corner[1]), big_endian);
    put(&bytes, corner[2], big_endian);
    put(&bytes, '\xFF');
  }
  for (const auto& face : kFaces) {
    put(&bytes, '\x03');
    for (const int c : face) put(&bytes, c, big_endian);
  }
  return bytes;
}

inline std::string wrlSample() {
  return "#VRML V2.0 utf8\n"
         "WorldInfo { title \"a { test }\" }\n"
         "Shape {\n  appearance Appearance { material Material { diffuseColor 1 0 0 } }\n"
         "  geometry IndexedFaceSet {\n"
         "    coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 0 0 1 ] }  # corners\n"
         "    coordIndex [ 0, 2, 1, -1, 0, 1, 3, -1, 0, 3, 2, -1, 1, 2, 3 ]\n  }\n}\n";
}

inline std::vector<Sample> surfaceSamples() {
  return {{"obj", ".obj", objSample()},
          {"off", ".off", offSample()},
          {"stl_text", ".stl", stlTextSample()},
          {"stl_binary", ".stl", stlBinarySample()},
          {"ply_text", ".ply", plyTextSample()},
          {"ply_little_endian", ".ply", plyBinarySample(false)},
          {"ply_big_endian", ".ply", plyBinarySample(true)},
          {"wrl", ".wrl", wrlSample()}};
}

}  // namespace palpate::formats
