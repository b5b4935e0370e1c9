// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of VTK's legacy files and of Medit's that are wrong.
#include <gtest/gtest.h>

#include "formats/refusals.h"
#include "formats/tet_formats.h"
#include "formats/tet_samples.h"

namespace palpate::formats::vtk_errors_test {
namespace {

void expectOfVtk(const std::string& good, const std::vector<Spoiling>& spoilings) {
  expectRefusals(parseTetMesh, "a.vtk", good, spoilings);
}

TEST(VtkErrors, OfTheHeader) {
  expectOfVtk(
      vtkSample(),
      {{"DataFile", "Datafile",
        "line 1 = # vtk Datafile Version 2.0: must begin with '# vtk DataFile Version '"},
       {"2.0", "6.0", "line 1 = 6.0: the version must be 1.0 ... 5.1"},
       {"2.0", "0.9", "line 1 = 0.9: the version must be 1.0 ... 5.1"},
       {"2.0", "nan", "line 1 = nan: the version must be 1.0 ... 5.1"},
       {"2.0", "two", "line 1 = two: the version must be 1.0 ... 5.1"},
       {"ASCII", "UTF-8", "line 3 = UTF-8: must be ASCII or BINARY"},
       {"DATASET", "FIELD", "line 4 = FIELD: must be 'DATASET'"},
       {"UNSTRUCTURED_GRID", "POLYDATA", "line 4 = POLYDATA: must be 'UNSTRUCTURED_GRID'"}});
}

TEST(VtkErrors, OfSections) {
  expectOfVtk(vtkSample(),
              {{"POINT_DATA", "EDGE_DATA",
                "line 15 = EDGE_DATA: must be a section of an unstructured grid: POINTS, CELLS, "
                "CELL_TYPES, ..."},
               {"CELL_TYPES 3\n5\n10\n10\n", "CELL_TYPES 2\n10\n10\n",
                "line 23: truncated: there must be as many CELL_TYPES as CELLS"},
               {"POINTS 6", "POINTS -6", "line 5 = -6: must not be negative: number of points"}});
  const std::string no_fit = ": the cells must fit the size that CELLS announces";
  expectOfVtk(vtkSample(), {{"4 2 3 4 5", "4.5 2 3 4 5", "line 10 = cell 3" + no_fit},
                            {"CELLS 3 14", "CELLS 2 14", "line 10 = 5 numbers left" + no_fit}});
  expectOfVtk(vtk51Sample(),
              {{"CONNECTIVITY", "CONNECTIONS", "line 13 = CONNECTIONS: must be 'CONNECTIVITY'"}});
}

TEST(VtkErrors, OfArraysInText) {
  const std::string no_type = ": must be a VTK type: int, float, double, vtktypeint64, ...";
  expectOfVtk(
      vtkSample(),
      {{"POINTS 6 float", "POINTS 6 real", "line 5 = real" + no_type},
       {"SCALARS region int 1", "SCALARS region int 0",
        "line 22 = 0: the number of components must be 1 ... 9"},
       {"SCALARS region int 1", "SCALARS region int 10",
        "line 22 = 10: the number of components must be 1 ... 9"},
       {"SCALARS region int 1", "SCALARS region int one",
        "line 22 = one: must be a whole number: number of components"},
       {"1 nan 1", "1 one 1", "line 21 = one: must be a number: value of an array"},
       {"1 7 9\n", "1 7    ", "line 24: ends where a number is expected: value of an array"},
       {"1 7 9\n", "1 7", "line 23 = 3: truncated or wrong numbers: only 3 bytes follow"}});
  expectOfVtk(vtkSample() + "TEXTURE_COORDINATES t 2 float\n0 0 0 0 0 0\n",
              {{"t 2 float", "t 0 float", "line 25 = 0: the number of components must be 1 ... 9"},
               {"t 2 float", "t 2 string", "line 25 = string" + no_type}});
}

TEST(VtkErrors, OfArraysInBinary) {
  const std::string good = vtkBinarySample();
  const std::string points = "POINTS 6 double\n", more = "POINTS 40 double\n";
  const std::size_t at = good.find(points) + more.size();
  const std::string bits = good + "SCALARS flag bit\nLOOKUP_TABLE default\n";
  const std::string left = std::to_string(good.size() + more.size() - points.size() - at);
  expectRefusals(
      parseTetMesh, "a.vtk",
      {{changed(good, points, more),
        "byte " + std::to_string(at) + ": truncated: array takes 960 bytes, there are " + left},
       {bits, "byte " + std::to_string(bits.size()) +
                  ": truncated: array of bits takes 1 bytes, there are 0"}});
  EXPECT_NO_THROW(parseTetMesh("a.vtk", bits + '\x05'));
}

TEST(VtkErrors, OfCells) {
  const std::string no_region = ": the region must be a whole number";
  expectOfVtk(
      vtkSample(),
      {{"1 7 9", "1 7.5 9", "cell 2 (counted from 1)" + no_region},
       {"1 7 9", "1 7 nan", "cell 3 (counted from 1)" + no_region},
       {"1 7 9", "1 7 1e10", "cell 3 (counted from 1)" + no_region},
       {"5\n10\n10\n", "5\n10\n10.5\n",
        "cell 3 (counted from 1): the type must be a whole number of 0 ... 255"},
       {"5\n10\n10\n", "5\n10\nnan\n",
        "cell 3 (counted from 1): the type must be a whole number of 0 ... 255"},
       {"5\n10\n10\n", "5\n10\n24\n", "cell 3 (counted from 1): must have 10 points by its type"}});
  expectOfVtk(vtk51Sample(),
              {{"0 3 7 11", "1 3 7 11", "line 12 = OFFSETS: must begin with 0"},
               {"0 3 7 11", "nan 3 7 11", "line 12 = OFFSETS: must begin with 0"},
               {"0 3 7 11", "0 3 8 11", "cell 2 (counted from 1): must have 4 points by its type"},
               {"0 3 7 11", "0 3 6 11", "cell 2 (counted from 1): must have 4 points by its type"},
               {"0 3 7 11", "0 3 6.5 11",
                "cell 2 (counted from 1): the offsets must grow, and end within the "
                "connectivity"}});
}

TEST(MeditErrors, OfSections) {
  std::vector<Spoiling> spoilings = {
      {"MeshVersionFormatted", "MeshVersion",
       "line 1 = MeshVersion: must be 'MeshVersionFormatted'"},
      {"Formatted 2", "Formatted 0", "line 1 = 0: the version must be 1, 2 or 3"},
      {"Formatted 2", "Formatted two", "line 1 = two: must be a whole number: version"},
      {"Triangles 1\n1 4 3 5\n", "Vertices 1\n0 0 0 0\n",
       "line 13 = Vertices: must not come twice"},
      {"Ridges", "ridges",
       "line 19 = ridges: must be the name of a section: Vertices, Tetrahedra, ..., End"}};
  for (const std::string other :
       {"Hexahedra", "Prisms", "Pyramids", "HexahedraP2", "TetrahedraP3"}) {
    EXPECT_NO_THROW(parseTetMesh("a.mesh", changed(meditSample(), "Ridges 1\n1", other + " 0")));
    spoilings.push_back({"Ridges", other, "line 19 = " + other + ": only tetrahedra are read"});
  }
  expectRefusals(parseTetMesh, "a.mesh", meditSample(), spoilings);
}

TEST(MeditErrors, OfNumbers) {
  expectRefusals(
      parseTetMesh, "a.mesh", meditSample(),
      {{"Tetrahedra\n2", "Tetrahedra\n-2",
        "line 16 = -2: must not be negative: number of tetrahedra"},
       {"3 4 5 6 9", "3 4 5 -9223372036854775808 9",
        "tetrahedra = 1 of 2, the first is number 2: a node index is out of range; there are 6 "
        "points"},
       {"3 4 5 6 9", "3 4 5 6 2147483648",
        "line 18 = 2147483648: is too large: reference of a tetrahedron"},
       {"3 4 5 6 9", "3 4 5 6.5 9", "line 18 = 6.5: must be a whole number: node of a tetrahedron"},
       {"5 5 5 1", "5 inf 5 1", "line 8 = inf: must be finite: y of a vertex"},
       {"5 5 5 1", "5 5 5 x", "line 8 = x: must be a number: reference of a vertex"}});
  expectRefusals(parseTetMesh, "a.mesh",
                 {{"MeshVersionFormatted 1\nDimension\n",
                   "line 3: ends where a whole number is expected: dimension"}});
}

}  // namespace
}  // namespace palpate::formats::vtk_errors_test
