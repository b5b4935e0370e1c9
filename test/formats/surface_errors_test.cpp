// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of surfaces that are wrong, of each format.
#include <gtest/gtest.h>

#include <limits>

#include "formats/refusals.h"
#include "formats/surface_formats.h"
#include "formats/surface_samples.h"

namespace palpate::formats::surface_errors_test {
namespace {

const std::string kOut = ": the index is out of range; there are ";

TEST(ObjErrors, OfNumbers) {
  expectRefusals(
      parseSurface, "a.obj", objSample(),
      {{"v 1 0 0", "v 1 0", "line 4: ends where a number is expected: z of a vertex"},
       {"v 1 0 0", "v 1 0 0x", "line 4 = 0x: must be a number: z of a vertex"},
       {"f 1 3 2", "f 1 /3 2",
        "line 7: ends where a whole number is expected: vertex index of a face"},
       {"f 1 3 2", "f 1 0/3 2", "line 7 = 0/3: a vertex index must not be 0: they count from 1"},
       {"f 1 3 2", "f 9223372036854775808 3 2",
        "line 7 = 9223372036854775808: must be a whole number: vertex index of a face"},
       {"f 1 3 2", "f -9223372036854775808 3 2", "line 7 = corner 1" + kOut + "4 vertices"}});
}

TEST(SurfaceErrors, TenProblemsAreToldAndTheOthersCounted) {
  std::string text = "v 0 0 0\n", all;
  for (int i = 2; i <= 13; ++i) {
    text += "f 1\n";
    if (i > 11) continue;
    all +=
        "a.obj: line " + std::to_string(i) + " = 1 corners: a face must have 3 corners or more\n";
  }
  EXPECT_EQ(test::complaint([&] { parseSurface("a.obj", text); }),
            all + "a.obj: and 2 more problems");
}

TEST(OffErrors, OfNumbers) {
  expectRefusals(
      parseSurface, "a.off", offSample(),
      {{"OFF", "off", "line 1 = off: must begin with OFF, COFF, NOFF, STOFF or a mixture of them"},
       {"4 4 6", "4 -4 6", "line 2 = -4: must not be negative: number of faces"},
       {"4 4 6", "4 4 x", "line 2 = x: must be a whole number: number of edges"},
       {"1 0 0\n", "1 0\n", "line 4: ends where a number is expected: z of a vertex"},
       {"3 0 2 1", "-3 0 2 1", "line 7 = -3: must not be negative: number of corners of a face"},
       {"3 0 2 1", "99 0 2 1",
        "line 7 = 99: truncated or wrong number of corners of a face: only 31 bytes follow"},
       {"3 0 2 1", "4 0 2 1",
        "line 7: ends where a whole number is expected: vertex index of a face"}});
  expectRefusals(parseSurface, "a.off",
                 {{"OFF\n", "line 2: ends where a whole number is expected: number of vertices"}});
}

TEST(StlErrors, OfText) {
  expectRefusals(parseSurface, "a.stl", stlTextSample(),
                 {{"    endloop\n", "", "line 7 = endfacet: must be 'endloop'"},
                  {"    endloop\n  endfacet\n", "", "line 7 = facet: must be 'endloop'"},
                  {"outer", "inner",
                   "line 3 = inner: must be one of solid, facet, outer loop, vertex, endloop, "
                   "endfacet, endsolid"},
                  {"vertex 0.000000 0.000000 0.000000", "vertex 0.0 0.0",
                   "line 5 = vertex: must be a number: z of a vertex"}});
}

TEST(StlErrors, OfBinary) {
  const std::string good = stlBinarySample();
  expectRefusals(
      parseSurface, "a.stl",
      {{"facets", "byte 0: truncated: the header of a binary STL file takes 80 bytes, there are 6"},
       {good.substr(0, 82), "byte 80: truncated: the number of facets takes 4 bytes, there are 2"},
       {good.substr(0, good.size() - 1),
        "byte 80 = 4 facets: truncated, or no STL file: only 199 bytes follow, a facet has 50"},
       {std::string(good).replace(84 + 50 + 12, 4,
                                  packed<float>({std::numeric_limits<double>::infinity()})),
        "byte 134: the coordinates of a facet must be finite"}});
}

TEST(PlyErrors, OfTheHeader) {
  const std::string no_type =
      ": must be a PLY type: char, uchar, short, ushort, int, uint, float, ...";
  const std::string no_key = ": must be format, element, property, comment or end_header";
  expectRefusals(
      parseSurface, "a.ply", plyTextSample(),
      {{"float y", "real y", "line 6 = real" + no_type},
       {"list uchar int", "list byte int", "line 10 = byte" + no_type},
       {"list uchar int vertex_indices", "list uchar", "line 10" + no_type},
       {"element vertex 4\n", "", "line 4 = property: an element must come first"},
       {"element vertex 4", "element vertex -4",
        "line 4 = -4: must not be negative: number of elements"},
       {"element vertex 4", "element vertex four",
        "line 4 = four: must be a whole number: number of elements"},
       {"element vertex 4", "element point 4", "line 11: the header must have an element 'vertex'"},
       {"comment", "remark", "line 3 = remark" + no_key},
       {"format ascii 1.0\n", "", "line 10: the header must have a format line"},
       {"end_header", "element tag 2\nend_header",
        "line 12 = tag: an element must have a property"}});
  expectRefusals(parseSurface, "a.ply",
                 {{"ply\nformat ascii 1.0\n", "line 3: truncated: the header has no end"}});
}

TEST(PlyErrors, OfTheData) {
  expectRefusals(
      parseSurface, "a.ply", plyTextSample(),
      {{"3 0 2 1", "-3 0 2 1", "line 16 = -3.000000: must be the length of a list"},
       {"3 0 2 1", "3.9 0 2 1", "line 16 = 3.900000: must be the length of a list"},
       {"3 0 2 1", "3 0.9 2 1", "face 1 = corner 1" + kOut + "4 vertices"},
       {"3 0 2 1", "4000000000 0 2 1", "line 16 = 4000000000.000000: must be the length of a list"},
       {"3 0 2 1", "99 0 2 1",
        "line 16 = 99: truncated or wrong length of a list: only 31 bytes follow"},
       {"3 0 2 1", "x 0 2 1", "line 16 = x: must be a number: length of a list"},
       {"3 1 2 3\n", "3 1 2 4000000000", "face 4 = corner 3" + kOut + "4 vertices"}});
  for (const bool big : {false, true}) {
    const std::string good = plyBinarySample(big);
    const std::size_t data = plyHeader(big ? "binary_big_endian" : "binary_little_endian").size();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expectRefusals(parseSurface, "a.ply",
                   {{std::string(good).replace(data + 17, 4, packed<float>({nan}, big)),
                     "vertex 2 (counted from 1): the coordinates must be finite"},
                    {good.substr(0, good.size() - 3),
                     "byte " + std::to_string(good.size() - 4) +
                         ": truncated: property of a face takes 4 bytes, there are 1"}});
  }
}

void expectOfWrl(std::vector<Refusal> refusals) {
  for (Refusal& refusal : refusals) refusal.bytes.insert(0, "#VRML V2.0 utf8\n");
  expectRefusals(parseSurface, "a.wrl", refusals);
}

TEST(WrlErrors, OfSyntax) {
  const std::string no_value = ": must be a number, a string or a node";
  expectOfWrl({{"WorldInfo { title \"open", "line 2: a string that has no end"},
               {"WorldInfo { title \"open\\", "line 2: a string that has no end"},
               {"Group {", "line 2: truncated: '}' must follow"},
               {"Group { children", "line 2: truncated: a value must follow"},
               {"Group children", "line 2 = children: must be '{'"},
               {"Group", "line 2: truncated: '{' must follow"},
               {"Group { children\n\nx }", "line 4 = x" + no_value},
               {"Group { children x\n\n}", "line 2 = x" + no_value},
               {"Group { children x }", "line 2 = x" + no_value},
               {"Group { children ] }", "line 2 = ]" + no_value},
               {"Transform { scale inf 1 1 }", "line 2 = inf: must be finite"},
               {"Transform { scale [ 1 inf 1 ] }", "line 2 = inf: must be finite"},
               {"Group { children [\n  USE A ] }",
                "line 3 = A: USE must name a node that DEF named before"},
               {"EXTERNPROTO A [] \"b.wrl\"\n",
                "line 2 = EXTERNPROTO: prototypes are not read; write plain nodes"},
               {"ROUTE a.b c.d\n", "line 2 = c.d: must be 'TO'"},
               {"ROUTE a.b", "line 2: truncated: 'TO' must follow"}});
}

TEST(WrlErrors, OfFields) {
  const std::string corners = "coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] } ";
  const auto faces = [](const std::string& fields) {
    return "Shape { geometry IndexedFaceSet { " + fields + "} }\n";
  };
  expectOfWrl(
      {{"Transform { scale 1 2 }", "line 2 = Transform: scale must have 3 numbers"},
       {"Transform { center [ ] }", "line 2 = Transform: center must have 3 numbers"},
       {"Transform { rotation 0 0 1 }", "line 2 = Transform: rotation must have 4 numbers"},
       {"Transform { rotation 0 0 0 1 }", "line 2 = Transform: rotation must have an axis"},
       {"Transform { scaleOrientation 0 0 0 1 }",
        "line 2 = Transform: scaleOrientation must have an axis"},
       {"Switch { whichChoice 1 2 }", "line 2 = Switch: whichChoice must have 1 numbers"},
       {"Shape { geometry Cone { } }", "line 2 = Cone: must be an IndexedFaceSet"},
       {faces("coord Coordinate { point [ 0 0 0 1 ] } "),
        "line 2 = IndexedFaceSet: the numbers in 'point' must be a multiple of 3"},
       {faces(corners + "ccw [ TRUE FALSE ] "), "line 2 = IndexedFaceSet: ccw must have 1 numbers"},
       {faces(corners + "coordIndex [ 0 1 2.5 ] "),
        "line 2 = IndexedFaceSet: coordIndex must have whole numbers"},
       {faces("coordIndex [ 0 1 2 ] "),
        "line 2, IndexedFaceSet: face 1 = corner 1" + kOut + "0 vertices"},
       {"Transform { translation 1e308 0 0 center 1e308 0 0\nchildren " + faces(corners) + "}",
        "vertex 1 (counted from 1): the coordinates must be finite\n"
        "a.wrl: vertex 2 (counted from 1): the coordinates must be finite\n"
        "a.wrl: vertex 3 (counted from 1): the coordinates must be finite"},
       {faces(corners), "there is no triangle in this file"}});
}

}  // namespace
}  // namespace palpate::formats::surface_errors_test
