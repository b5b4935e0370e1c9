// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/formats/vtu_writer.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "palpate/formats/tet_io.h"
#include "support/temp_folder.h"

namespace palpate::formats::vtu_writer_test {
namespace {

/// A box whose coordinates have all their bits in use.
mesh::TetMesh irrationalBox() {
  mesh::TetMesh mesh =
      mesh::boxMesh(Vec3(M_PI, std::sqrt(2.0), 1.0 / 3.0), Eigen::Vector3i(3, 2, 2));
  mesh.points.array() += 1e-3 * std::exp(1.0);
  return mesh;
}

/// One 10-node tetrahedron with curved edges.
mesh::TetMesh quadraticTet() {
  mesh::TetMesh mesh;
  mesh.points = Points::Random(3, 10) * 0.05;
  mesh.points.leftCols(4) << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  mesh.tets = Eigen::Vector4i(0, 1, 2, 3);
  mesh.midnodes.resize(6, 1);
  mesh.midnodes << 9, 8, 7, 6, 5, 4;
  mesh.region = {-5};
  return mesh;
}

void expectSame(const mesh::TetMesh& a, const mesh::TetMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.midnodes, b.midnodes);
  EXPECT_EQ(a.region, b.region);
}

TEST(VtuWriter, IsReadBackBitForBit) {
  const test::TempFolder dir;
  const std::string file = dir.path("a.vtu");
  mesh::TetMesh mesh = irrationalBox();
  writeVtu(file, mesh, {}, {});
  expectSame(readTetMesh(file), mesh);
  for (int i = 0; i < mesh.numTets(); ++i) mesh.region.push_back(i - 7);
  writeVtu(file, mesh, {{"u", Eigen::MatrixXd::Random(3, mesh.numPoints())}},
           {{"J", Eigen::MatrixXd::Random(1, mesh.numTets())}});
  expectSame(readTetMesh(file), mesh);
  const mesh::TetMesh quadratic = quadraticTet();
  writeVtu(file, quadratic, {}, {});
  expectSame(readTetMesh(file), quadratic);
}

TEST(VtuWriter, HexahedraHaveTheirType) {
  const test::TempFolder dir;
  mesh::CellMesh box;
  box.points = Points::Random(3, 8);
  box.cells = Eigen::VectorXi::LinSpaced(8, 0, 7);
  writeVtu(dir.path("a.vtu"), box, {}, {});
  const std::string bytes = test::fileBytes(dir.path("a.vtu"));
  EXPECT_EQ(bytes[bytes.rfind("\n</AppendedData>") - 1], 12);  // VTK_HEXAHEDRON, the last block
  box.cells.conservativeResize(5, 1);
  EXPECT_THROW(writeVtu(dir.path("b.vtu"), box, {}, {}), std::invalid_argument);
}

TEST(VtuWriter, SameMeshSameBytesAndNothingLeftBehind) {
  const test::TempFolder dir;
  writeVtu(dir.path("a.vtu"), irrationalBox(), {}, {});
  writeVtu(dir.path("b.vtu"), irrationalBox(), {}, {});
  writeVtu(dir.path("b.vtu"), irrationalBox(), {}, {});
  EXPECT_EQ(test::fileBytes(dir.path("a.vtu")), test::fileBytes(dir.path("b.vtu")));
  int entries = 0;
  for ([[maybe_unused]] const auto& e : std::filesystem::directory_iterator(dir.path("")))
    ++entries;
  EXPECT_EQ(entries, 2);
}

/// The array's block, found by the XML alone.
std::vector<double> appendedDoubles(const std::string& bytes, const char* parent,
                                    const char* name) {
  const std::size_t tag = bytes.find("<AppendedData");
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse((bytes.substr(0, tag) + "</VTKFile>").c_str()), tinyxml2::XML_SUCCESS);
  const auto* piece = document.RootElement()->FirstChildElement()->FirstChildElement("Piece");
  for (const auto* e = piece->FirstChildElement(parent)->FirstChildElement(); e;
       e = e->NextSiblingElement()) {
    if (!e->Attribute("Name", name)) continue;
    const char* block = bytes.data() + bytes.find('_', tag) + 1 + e->IntAttribute("offset");
    std::uint64_t size = 0;
    std::memcpy(&size, block, sizeof size);
    std::vector<double> values(size / sizeof(double));
    std::memcpy(values.data(), block + sizeof size, size);
    return values;
  }
  return {};
}

TEST(VtuWriter, ArraysAreThereWithTheirNames) {
  const test::TempFolder dir;
  const mesh::TetMesh mesh = irrationalBox();
  const Eigen::MatrixXd u = Eigen::MatrixXd::Random(3, mesh.numPoints());
  const Eigen::MatrixXd s = Eigen::MatrixXd::Random(6, mesh.numTets());
  writeVtu(dir.path("a.vtu"), mesh, {{"u <m> & \"so\"", u}}, {{"stress", s}});
  const std::string bytes = test::fileBytes(dir.path("a.vtu"));
  const std::vector<double> u_back = appendedDoubles(bytes, "PointData", "u <m> & \"so\"");
  const std::vector<double> s_back = appendedDoubles(bytes, "CellData", "stress");
  ASSERT_EQ(static_cast<Eigen::Index>(u_back.size()), u.size());
  ASSERT_EQ(static_cast<Eigen::Index>(s_back.size()), s.size());
  EXPECT_EQ(std::memcmp(u_back.data(), u.data(), sizeof(double) * u_back.size()), 0);
  EXPECT_EQ(std::memcmp(s_back.data(), s.data(), sizeof(double) * s_back.size()), 0);
}

TEST(VtuWriter, RefusesArraysThatDoNotFit) {
  const test::TempFolder dir;
  const std::string file = dir.path("a.vtu");
  mesh::TetMesh mesh = irrationalBox();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Zero(1, 1);
  EXPECT_THROW(writeVtu(file, mesh, {{"u", one}}, {}), std::invalid_argument);
  EXPECT_THROW(writeVtu(file, mesh, {}, {{"u", one}}), std::invalid_argument);
  EXPECT_THROW(writeVtu(file, mesh, {{"", Eigen::MatrixXd::Zero(1, mesh.numPoints())}}, {}),
               std::invalid_argument);
  mesh.region = {1};
  EXPECT_THROW(writeVtu(file, mesh, {}, {}), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_THROW(writeVtu(dir.path("no/folder/a.vtu"), irrationalBox(), {}, {}), std::runtime_error);
}

}  // namespace
}  // namespace palpate::formats::vtu_writer_test
