// SPDX-License-Identifier: GPL-3.0-or-later
// Cell data of .vtk and .vtu files other than the region.
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/formats/tet_io.h"
#include "palpate/formats/vtu_writer.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::formats::cell_data_test {
namespace {

constexpr char kVtkHead[] = R"(# vtk DataFile Version 3.0
two tetrahedra after a triangle
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
CELLS 3 14
3 0 2 1
4 0 1 2 3
4 1 2 3 4
CELL_TYPES 3
5 10 10
)";

class CellData : public ::testing::Test {
 protected:
  mesh::TetMesh readVtk(const std::string& cell_data) const {
    return readTetMesh(folder_.write("mesh.vtk", kVtkHead + cell_data));
  }
  test::TempFolder folder_;
};

TEST_F(CellData, OfVtkArraysOfOneAndThreeComponents) {
  const mesh::TetMesh mesh = readVtk(R"(CELL_DATA 3
SCALARS tissue int 1
LOOKUP_TABLE default
5 6 7
VECTORS fibres double
0 0 0  1 0 0  0 nan 2
TENSORS left_out double
1 2 3 4 5 6 7 8 9  1 2 3 4 5 6 7 8 9  1 2 3 4 5 6 7 8 9
FIELD more 1
sheets 3 3 float
9 9 9  0 1 0  0 0 1
POINT_DATA 5
SCALARS of_points int 1
LOOKUP_TABLE default
1 2 3 4 5
)");
  ASSERT_EQ(mesh.cell_data.size(), 3u);
  EXPECT_EQ(mesh.cell_data.at("tissue"), (Eigen::MatrixXd(1, 2) << 6, 7).finished());
  EXPECT_EQ(mesh.cell_data.at("fibres").col(0), Vec3(1, 0, 0));
  EXPECT_TRUE(std::isnan(mesh.cell_data.at("fibres")(1, 1)));
  EXPECT_EQ(mesh.cell_data.at("fibres")(2, 1), 2.0);
  EXPECT_EQ(mesh.cell_data.at("sheets").col(1), Vec3(0, 0, 1));
  EXPECT_TRUE(mesh.region.empty());
}

TEST_F(CellData, OfVtkRegionIsBoth) {
  const mesh::TetMesh mesh = readVtk("CELL_DATA 3\nFIELD f 1\ngmsh:physical 1 3 int\n1 2 3\n");
  EXPECT_EQ(mesh.region, (std::vector<int>{2, 3}));
  EXPECT_EQ(mesh.cell_data.at("gmsh:physical")(0, 1), 3.0);
}

TEST_F(CellData, AsManyAsCells) {
  const auto problems = test::problemsOf(
      [&] { readVtk("CELL_DATA 2\nSCALARS tissue int 1\nLOOKUP_TABLE default\n5 6\n"); });
  EXPECT_TRUE(test::hasProblem(problems, "cell data tissue", "as many as cells, 3"));
}

TEST_F(CellData, OfVtuComesBackAsWritten) {
  const mesh::TetMesh box = mesh::boxMesh(Vec3(1, 2, 3), Eigen::Vector3i(2, 1, 1));
  const Eigen::MatrixXd fibres = Eigen::MatrixXd::Random(3, box.numTets());
  const Eigen::MatrixXd tissue = Eigen::MatrixXd::Constant(1, box.numTets(), 4.0);
  const Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, box.numTets());
  const std::string file = folder_.path("box.vtu");
  writeVtu(file, box, {}, {{"fibres", fibres}, {"tissue", tissue}, {"stress", stress}});
  const mesh::TetMesh mesh = readTetMesh(file);
  EXPECT_EQ(mesh.cell_data.at("fibres"), fibres);
  EXPECT_EQ(mesh.cell_data.at("tissue"), tissue);
  EXPECT_EQ(mesh.cell_data.count("stress"), 0u);
}

TEST_F(CellData, OfVtuPieces) {
  const auto piece = [](const std::string& data) {
    return R"(<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64"
      NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
      <DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
      <DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
      <DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
      <CellData>)" +
           data + "</CellData></Piece>";
  };
  const auto read = [&](const std::string& first, const std::string& second) {
    return readTetMesh(folder_.write(
        "pieces.vtu", R"(<VTKFile type="UnstructuredGrid"><UnstructuredGrid>)" + piece(first) +
                          piece(second) + "</UnstructuredGrid></VTKFile>"));
  };
  const std::string scalar = R"(<DataArray type="Int32" Name="a" format="ascii">3</DataArray>)";
  const std::string vector =
      R"(<DataArray type="Float32" Name="a" NumberOfComponents="3" format="ascii">1 2 3</DataArray>)";
  const mesh::TetMesh mesh = read("", scalar);
  EXPECT_TRUE(std::isnan(mesh.cell_data.at("a")(0, 0)));
  EXPECT_EQ(mesh.cell_data.at("a")(0, 1), 3.0);
  EXPECT_TRUE(std::isnan(read(scalar, "").cell_data.at("a")(0, 1)));
  EXPECT_TRUE(test::hasProblem(test::problemsOf([&] { read(scalar, vector); }), "cell data a",
                               "as many in all pieces"));
  EXPECT_NO_THROW(
      read(R"(<DataArray type="String" Name="words" format="ascii">97 0</DataArray>)", ""));
}

}  // namespace
}  // namespace palpate::formats::cell_data_test
