// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/formats/tet_io.h"

#include <gtest/gtest.h>

#include "formats/tet_formats.h"
#include "formats/tet_samples.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::formats::tet_io_test {
namespace {

const test::TempFolder& dir() {
  static const test::TempFolder temp;
  return temp;
}

mesh::TetMesh readText(const std::string& name, const std::string& bytes) {
  return readTetMesh(dir().write(name, bytes));
}
std::string complaintAbout(const std::string& name, const std::string& bytes) {
  return test::complaint([&] { readText(name, bytes); });
}
std::string with(std::string text, const std::string& from, const std::string& to) {
  EXPECT_TRUE(test::contains(text, from)) << from;
  return text.replace(text.find(from), from.size(), to);
}

class EveryTetFormat : public testing::TestWithParam<Sample> {};

TEST_P(EveryTetFormat, ReadsTwoTetrahedra) {
  const mesh::TetMesh mesh = readText("a" + GetParam().extension, GetParam().bytes);
  Points points(3, 5);  // without the unused one
  points << 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1;
  EXPECT_EQ(mesh.points, points);
  EXPECT_EQ(mesh.tets, (Eigen::Matrix4Xi(4, 2) << 0, 1, 1, 2, 2, 3, 3, 4).finished());
  EXPECT_EQ(mesh.region, (std::vector<int>{7, 9}));
  EXPECT_FALSE(mesh.quadratic());
}

TEST_P(EveryTetFormat, RefusesMissingAndEmptyFiles) {
  const std::string missing = dir().path("missing" + GetParam().extension);
  EXPECT_EQ(test::complaint([&] { readTetMesh(missing); }), missing + ": no such file");
  const std::string empty = "empty" + GetParam().extension;
  EXPECT_EQ(complaintAbout(empty, ""), dir().path(empty) + ": the file is empty");
  EXPECT_NE(complaintAbout(empty, "\n"), "");
}

INSTANTIATE_TEST_SUITE_P(All, EveryTetFormat, testing::ValuesIn(tetSamples()),
                         [](const auto& sample) { return sample.param.name; });

TEST(TetFile, UnknownExtensionListsTheKnownOnes) {
  const std::string text = complaintAbout("a.inp", "x");
  EXPECT_TRUE(test::contains(text, "extension = .inp")) << text;
  EXPECT_TRUE(test::contains(text, ".mesh, .msh, .vtk, .vtu")) << text;
}

// The unit tetrahedron with its mid-edge nodes, each where its edge says, in VTK's order.
const char* const kQuadraticPoints =
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.5 0 0\n0.5 0.5 0\n0 0.5 0\n0 0 0.5\n0.5 0 0.5\n0 0.5 0.5\n";

std::string numbered(const std::string& lines, const std::string& before,
                     const std::string& after) {
  std::string out, line;
  int i = 0;
  for (const char c : lines) {
    if (c != '\n') {
      line += c;
      continue;
    }
    ++i;
    out += (before == "#" ? std::to_string(i) + " " : before) + line + after + '\n';
    line.clear();
  }
  return out;
}

std::string quadraticFile(const std::string& extension) {
  const std::string points = kQuadraticPoints;
  if (extension == ".msh") {  // Gmsh exchanges the last two
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n" + numbered(points, "#", "") +
           "$EndNodes\n$Elements\n1\n1 11 2 0 3 1 2 3 4 5 6 7 8 10 9\n$EndElements\n";
  }
  if (extension == ".vtk") {
    return "# vtk DataFile Version 3.0\nq\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n" +
           points + "CELLS 1 11\n10 0 1 2 3 4 5 6 7 8 9\nCELL_TYPES 1\n24\n";
  }
  return "MeshVersionFormatted 2 Dimension 3 Vertices 10\n" + numbered(points, "", " 0") +
         "TetrahedraP2 1\n1 2 3 4 5 6 7 8 9 10 3\nEnd\n";
}

void expectMidnodesOnTheirEdges(const mesh::TetMesh& mesh) {
  constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  ASSERT_TRUE(mesh.quadratic());
  ASSERT_EQ(mesh.midnodes.cols(), mesh.numTets());
  for (int e = 0; e < 6; ++e) {
    const Vec3 a = mesh.points.col(mesh.tets(kEdges[e][0], 0));
    const Vec3 b = mesh.points.col(mesh.tets(kEdges[e][1], 0));
    EXPECT_EQ(Vec3(mesh.points.col(mesh.midnodes(e, 0))), Vec3(0.5 * (a + b))) << "edge " << e;
  }
}

TEST(TetFile, QuadraticTetrahedraComeInVtkOrder) {
  for (const std::string extension : {".msh", ".vtk", ".mesh"}) {
    SCOPED_TRACE(extension);
    const mesh::TetMesh mesh = readText("q" + extension, quadraticFile(extension));
    EXPECT_EQ(mesh.numPoints(), 10);
    expectMidnodesOnTheirEdges(mesh);
  }
}

TEST(TetFile, QuadraticTetrahedraOfTheOtherOrientationAreTurnedWithTheirMidnodes) {
  // Corners 1 0 2 3: edges 10 02 21 13 03 23 are points 4 6 5 8 7 9.
  const mesh::TetMesh mesh = readText(
      "q.vtk", with(quadraticFile(".vtk"), "10 0 1 2 3 4 5 6 7 8 9", "10 1 0 2 3 4 6 5 8 7 9"));
  EXPECT_GT(mesh::signedVolume(mesh.points, mesh.tets.col(0)), 0.0);
  expectMidnodesOnTheirEdges(mesh);
}

TEST(TetFile, AllInvertedIsAnotherConvention) {
  const std::string turned =
      with(with(msh1Sample(), "10 30 40 50", "30 10 40 50"), "30 40 50 60", "40 30 50 60");
  const mesh::TetMesh mesh = readText("a.msh", turned);
  for (int i = 0; i < 2; ++i) EXPECT_GT(mesh::signedVolume(mesh.points, mesh.tets.col(i)), 0.0);
}

TEST(TetFile, OneInvertedAmongOthersIsRefused) {
  const std::string text =
      complaintAbout("a.msh", with(msh1Sample(), "30 40 50 60", "40 30 50 60"));
  EXPECT_TRUE(test::contains(text, "inverted tetrahedra = 1 of 2, the first is number 2")) << text;
}

TEST(TetFile, FlatOnesAreRefused) {
  const std::string text = complaintAbout("a.msh", with(msh1Sample(), "60 1 1 1", "60 2 0 -1"));
  EXPECT_TRUE(test::contains(text, "without volume = 1 of 2, the first is number 2")) << text;
  EXPECT_NE(complaintAbout("a.msh", with(msh1Sample(), "30 40 50 60", "30 40 50 50")), "");
}

TEST(CheckTets, MeasuresFlatnessByTheEdges) {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(1e-6, 1e-6, 1e-6), Eigen::Vector3i(2, 2, 2));
  EXPECT_NO_THROW(checkTets(mesh, "small"));
  mesh.points *= 1e12;
  EXPECT_NO_THROW(checkTets(mesh, "large"));
  const mesh::TetMesh flat = mesh::boxMesh(Vec3(1, 1, 1e-13), Eigen::Vector3i(1, 1, 1));
  const std::string text = test::complaint([&] { checkTets(flat, "flat.vtu"); });
  EXPECT_TRUE(test::contains(text, "flat.vtu: tetrahedra without volume = 6 of 6")) << text;
  EXPECT_NO_THROW(checkTets(mesh::boxMesh(Vec3(1, 1, 1e-9), Eigen::Vector3i(1, 1, 1)), "thin"));
}

TEST(CheckTets, CountsBothKinds) {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(1, 1, 1), Eigen::Vector3i(1, 1, 1));
  mesh.tets.col(2).head<2>().reverseInPlace();
  mesh.tets.col(5).head<2>().reverseInPlace();
  mesh.tets(3, 4) = mesh.tets(0, 4);
  const std::string text = test::complaint([&] { checkTets(mesh, "m"); });
  EXPECT_TRUE(test::contains(text, "inverted tetrahedra = 2 of 6, the first is number 3")) << text;
  EXPECT_TRUE(test::contains(text, "without volume = 1 of 6, the first is number 5")) << text;
}

TEST(TetFile, MixedOrdersOtherVolumesAndDoublesAreRefused) {
  EXPECT_TRUE(test::contains(
      complaintAbout("a.mesh", with(quadraticFile(".mesh"), "End", "Tetrahedra 1\n1 2 3 4 1\nEnd")),
      "1 with 4 nodes, 1 with 10 nodes"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.mesh", with(meditSample(), "End", "Hexahedra 2\nEnd")),
                     "Hexahedra: only tetrahedra"));
  EXPECT_TRUE(test::contains(
      complaintAbout("a.msh", with(msh2Sample(), "1 2 2 1 1 10 40 30", "1 7 2 1 1 10 20 30 40 50")),
      "element type 7"));
  EXPECT_TRUE(test::contains(complaintAbout("a.vtk", with(vtkSample(), "5\n10\n10", "10\n10\n14")),
                             "cell 1"));
  EXPECT_TRUE(test::contains(complaintAbout("a.vtk", with(vtkSample(), "5\n10\n10", "5\n10\n14")),
                             "cell 3 (counted from 1): volume cells must be tetrahedra"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.msh", with(msh1Sample(), "30 40 50 60", "40 50 10 30")),
                     "tetrahedra = 1 of 2, the first is number 2: the same corners"));
}

TEST(TetFile, NoTetrahedronIsRefused) {
  EXPECT_TRUE(test::contains(complaintAbout("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"),
                             "there is no tetrahedron"));
  EXPECT_TRUE(test::contains(complaintAbout("a.vtk", with(vtkSample(), "5\n10\n10", "5\n9\n9")),
                             "there is no tetrahedron"));
  EXPECT_TRUE(test::contains(complaintAbout("a.mesh", "MeshVersionFormatted 1 Dimension 3 End"),
                             "there is no tetrahedron"));
}

TEST(Gmsh, RefusesWhatIsWrong) {
  EXPECT_TRUE(test::contains(complaintAbout("a.msh", with(msh2Sample(), "2.2 0", "4.0 0")),
                             "line 2 = 4.0: the version must be 1, 2.x or 4.1"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.msh", with(msh2Sample(), "30 40 50 60", "30 40 50 61")),
                     "line 21 = node 61: an element has a node that is not in the file"));
  EXPECT_TRUE(test::contains(complaintAbout("a.msh", with(msh2Sample(), "60 1 1 1", "50 1 1 1")),
                             "node 50: must not come twice"));
  EXPECT_TRUE(test::contains(complaintAbout("a.msh", with(msh2Sample(), "60 1 1 1", "60 1 inf 1")),
                             "must be finite"));
  EXPECT_TRUE(test::contains(complaintAbout("a.msh", with(msh2Sample(), "Nodes\n6", "Nodes\n7")),
                             "= $EndNodes: must be a whole number"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.msh", with(msh2Sample(), "Nodes\n6", "Nodes\n66666666")),
                     "truncated or wrong number of nodes"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.msh", with(msh1Sample(), "$ENDELM", "")), "$ENDELM"));
  EXPECT_TRUE(test::contains(complaintAbout("a.msh", with(msh1Sample(), "4 7 1 4", "4 7 1 5")),
                             "must have 4 nodes"));
  EXPECT_TRUE(test::contains(complaintAbout("a.msh", with(msh4Sample(), "3 9 4 1\n", "3 9 4 2\n")),
                             "more elements than the section announced"));
}

TEST(Gmsh, NonFiniteBinaryCoordinateIsRefused) {
  std::string bytes = msh2BinarySample(false);
  bytes.replace(bytes.find("$Nodes\n6\n") + 9 + 4, 8, packed<double>({std::nan("")}));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.msh", bytes), "points = 1 of 6, the first is number 1"));
}

TEST(Vtk, RefusesWhatIsWrong) {
  EXPECT_TRUE(
      test::contains(complaintAbout("a.vtk", with(vtkSample(), "UNSTRUCTURED_GRID", "POLYDATA")),
                     "UNSTRUCTURED_GRID"));
  EXPECT_TRUE(test::contains(complaintAbout("a.vtk", with(vtkSample(), "4 2 3 4 5", "4 2 3 4 6")),
                             "a point index is out of range"));
  EXPECT_TRUE(test::contains(complaintAbout("a.vtk", with(vtkSample(), "4 2 3 4 5", "5 2 3 4 5")),
                             "cell 3: the cells must fit"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.vtk", with(vtkSample(), "1 7 9", "1 7 9.5")), "region"));
  EXPECT_TRUE(test::contains(complaintAbout("a.vtk", with(vtk51Sample(), "0 3 7 11", "0 7 3 11")),
                             "offsets must grow"));
  EXPECT_TRUE(test::contains(complaintAbout("a.vtk", with(vtk51Sample(), "0 3 7 11", "0 3 7 12")),
                             "offsets must grow"));
  EXPECT_TRUE(test::contains(
      complaintAbout("a.vtk", with(vtkSample(), "CELL_TYPES 3\n5\n10\n10\n", "")), "CELL_TYPES"));
}

TEST(Vtu, RefusesWhatIsWrong) {
  const std::string good = vtuSample({});
  const auto complain = [&](const std::string& from, const std::string& to) {
    return complaintAbout("a.vtu", with(good, from, to));
  };
  EXPECT_TRUE(test::contains(complain("</Piece>", ""), "truncated, or no XML"));
  EXPECT_TRUE(test::contains(complain("UnstructuredGrid\" v", "PolyData\" v"), "UnstructuredGrid"));
  EXPECT_TRUE(test::contains(complain("Points=\"6\"", "Points=\"7\""), "truncated"));
  EXPECT_TRUE(
      test::contains(complain("Points=\"6\"", "Points=\"5\""), "must have 15 numbers, not more"));
  EXPECT_TRUE(test::contains(complain("Cells=\"3\"", "Cells=\"-3\""), "NumberOfCells"));
  EXPECT_TRUE(test::contains(complain("Points=\"6\"", "Points=\"2000000000\""), "truncated"));
  EXPECT_TRUE(test::contains(complain("0 3 2 0 2 3 4", "0 3 2 0 2 3 6"), "out of range"));
  EXPECT_TRUE(test::contains(complain("0 3 2 0 2 3 4", "0 3 2 0 2 3 -1"), "out of range"));
  EXPECT_TRUE(test::contains(complain("3 7 11", "3 7 1e300"), "offset"));
  EXPECT_TRUE(test::contains(complain("Name=\"types\"", "Name=\"tips\""), "DataArray 'types'"));
  EXPECT_TRUE(test::contains(complain("LittleEndian", "Middle"), "byte_order"));
  EXPECT_TRUE(
      test::contains(complain("byte_order", "compressor=\"vtkLZ4DataCompressor\" byte_order"),
                     "vtkZLibDataCompressor"));
}

TEST(Vtu, DamagedCompressedBlocksAreRefused) {
  const std::string good = vtuSample({VtuForm::kAppendedRaw, false, true, true});
  const mesh::TetMesh mesh = readText("a.vtu", good);
  int refused = 0, all = 0;
  for (std::size_t i = good.find("<AppendedData"); i < good.size(); i += 3, ++all) {
    std::string damaged = good;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    try {
      const mesh::TetMesh back = parseTetMesh("a.vtu", damaged);  // point data is not read
      EXPECT_EQ(back.points, mesh.points) << i;
      EXPECT_EQ(back.tets, mesh.tets) << i;
      EXPECT_EQ(back.region, mesh.region) << i;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, all / 3);
}

TEST(Vtu, OffsetOutsideOfTheDataIsRefused) {
  const std::string good = vtuSample({VtuForm::kAppendedRaw, false, false, false});
  const std::string types = "Name=\"types\" NumberOfComponents=\"1\" format=\"appended\" offset=\"";
  for (const std::string offset : {"99", "-", "x"}) {
    EXPECT_TRUE(test::contains(complaintAbout("a.vtu", with(good, types, types + offset)),
                               "the offset must be within AppendedData"))
        << offset;
  }
}

TEST(Vtu, PiecesAreJoined) {
  std::string text = vtuSample({});
  const std::size_t begin = text.find("<Piece"), end = text.find("</Piece>") + 9;
  std::string second = text.substr(begin, end - begin);
  second = with(second, "0 0 0 5 5 5 1 0 0 0 1 0 0 0 1 1 1 1\n</DataArray>\n</Points>",
                "3 0 0 5 5 5 4 0 0 3 1 0 3 0 1 4 1 1\n</DataArray>\n</Points>");
  const mesh::TetMesh mesh = readText("a.vtu", text.insert(end, second));
  EXPECT_EQ(mesh.numTets(), 4);
  EXPECT_EQ(mesh.numPoints(), 10);
  EXPECT_EQ(mesh.region, (std::vector<int>{7, 9, 7, 9}));
  EXPECT_EQ(mesh.points(0, mesh.tets(0, 2)), 3.0);
}

TEST(Medit, RefusesWhatIsWrong) {
  EXPECT_TRUE(
      test::contains(complaintAbout("a.mesh", with(meditSample(), "3 4 5 6 9", "3 4 5 7 9")),
                     "tetrahedra = 1 of 2, the first is number 2: a node index is out of range"));
  EXPECT_TRUE(test::contains(
      complaintAbout("a.mesh", with(meditSample(), "1 3 4 5 7", "0 3 4 5 7")), "out of range"));
  EXPECT_TRUE(test::contains(
      complaintAbout("a.mesh", with(meditSample(), "Dimension\n3", "Dimension 2")), "must be 3"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.mesh", with(meditSample(), "Formatted 2", "Formatted 9")),
                     "the version must be"));
}

}  // namespace
}  // namespace palpate::formats::tet_io_test
