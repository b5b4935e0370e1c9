// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes that say they are larger than they are, or that stand for more than they are large: read
// or refused in little memory, and in a time that grows as they do. tryBytes() looks at the memory.
#include <gtest/gtest.h>
#include <zlib.h>

#include <functional>

#include "formats/surface_samples.h"
#include "formats/tet_samples.h"
#include "palpate/base/error.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "targets.h"

namespace palpate::fuzz {
namespace {

using formats::Sample;

const Target& targetOf(const Sample& sample) { return targetNamed(sample.extension.substr(1)); }

std::vector<Sample> allSamples() {
  std::vector<Sample> all = formats::surfaceSamples();
  for (const Sample& sample : formats::tetSamples()) all.push_back(sample);
  return all;
}

bool refused(const char* target, const std::string& bytes) {
  return tryBytes(targetNamed(target), bytes) == Outcome::kRefused;
}
std::string complaintOf(const char* target, const std::string& bytes) {
  return test::complaint([&] { targetNamed(target).read(bytes); });
}
std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

class HostileMesh : public ::testing::TestWithParam<Sample> {};
INSTANTIATE_TEST_SUITE_P(Of, HostileMesh, ::testing::ValuesIn(allSamples()),
                         [](const auto& of) { return of.param.name; });

// Counts, indices, types, coordinates: each number of a file in turn.
TEST_P(HostileMesh, EveryNumberMayBeAnyNumber) {
  const std::string& bytes = GetParam().bytes;
  for (std::size_t begin = 0; begin < bytes.size(); ++begin) {
    if (!std::isdigit(static_cast<unsigned char>(bytes[begin]))) continue;
    std::size_t end = begin;
    while (end < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[end]))) ++end;
    for (const char* number :
         {"-1", "0", "1000000000", "2147483647", "2147483648", "-2147483648", "4294967295",
          "4294967296", "9223372036854775807", "-9223372036854775808", "9223372036854775808",
          "18446744073709551615", "18446744073709551616", "1e300", "1e400", "nan", "-inf",
          "0x7F"}) {
      SCOPED_TRACE(std::to_string(begin) + " " + number);
      EXPECT_NO_THROW(
          tryBytes(targetOf(GetParam()), bytes.substr(0, begin) + number + bytes.substr(end)));
    }
    begin = end;
  }
}

TEST_P(HostileMesh, EveryWordOfBytesMayBeAnyNumber) {
  for (const std::size_t size : {std::size_t{4}, std::size_t{8}}) {
    for (std::size_t at = 0; at + size <= GetParam().bytes.size(); ++at) {
      for (const std::uint64_t number :
           {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 31, std::uint64_t{1} << 63,
            (std::uint64_t{1} << 63) - 1, std::uint64_t{1000000000},
            std::uint64_t{0x7FF0000000000000}, std::uint64_t{0xFF80000000000000}}) {
        std::string bytes = GetParam().bytes, word;
        formats::put(&word, number, at % 2 == 0);
        bytes.replace(at, size, at % 2 == 0 ? word.substr(8 - size) : word.substr(0, size));
        SCOPED_TRACE(std::to_string(at) + " " + std::to_string(number));
        EXPECT_NO_THROW(tryBytes(targetOf(GetParam()), bytes));
      }
    }
  }
}

TEST(HostileMeshes, ABillionPointsInAHundredBytesAreRefused) {
  EXPECT_TRUE(refused("off", "OFF\n1000000000 1 0\n0 0 0\n"));
  EXPECT_TRUE(refused("ply",
                      "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\n"
                      "property float y\nproperty float z\nelement face 1\n"
                      "property list uchar int vertex_indices\nend_header\n"));
  EXPECT_TRUE(refused("stl", std::string(80, ' ') + "\xFF\xFF\xFF\x7F" + std::string(50, ' ')));
  EXPECT_TRUE(
      refused("msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1000000000\n1 0 0 0\n"));
  EXPECT_TRUE(refused("msh", "$NOD\n1000000000\n1 0 0 0\n"));
  EXPECT_TRUE(refused("vtk",
                      "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
                      "POINTS 1000000000 double\n"));
  EXPECT_TRUE(
      refused("mesh", "MeshVersionFormatted 1\nDimension 3\nVertices\n1000000000\n0 0 0 0\n"));
  EXPECT_TRUE(refused("vtu",
                      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints"
                      "=\"1000000000\" NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" "
                      "NumberOfComponents=\"3\" format=\"ascii\">0</DataArray></Points></Piece>"
                      "</UnstructuredGrid></VTKFile>"));
}

// A strip of tetrahedra as flat as numbers allow, half of them turned, all on each other's faces.
TEST(HostileMeshes, AMillionSliversAreReadOrRefused) {
  constexpr int kSlivers = 1000000;
  std::string text =
      "MeshVersionFormatted 1\nDimension 3\nVertices\n" + std::to_string(kSlivers + 3) + "\n";
  for (int i = 0; i < kSlivers + 3; ++i) {
    text += std::to_string(i) + " " + std::to_string(i % 2) + (i % 3 ? " 0 0\n" : " 1e-12 0\n");
  }
  text += "Tetrahedra\n" + std::to_string(kSlivers) + "\n";
  for (int i = 1; i <= kSlivers; ++i) {
    for (int corner = 0; corner < 4; ++corner) text += std::to_string(i + corner) + " ";
    text += "0\n";
  }
  EXPECT_NO_THROW(tryBytes(targetNamed("mesh"), text + "End\n"));
}

// Tags that a table of hashes, of a size that libstdc++ chooses, would have in one place.
TEST(HostileMeshes, TagsOfNodesMayBeAnyNumbers) {
  constexpr std::int64_t kApart = std::int64_t{520241} * 1056323;
  for (const bool rising : {true, false}) {
    std::string nodes;
    constexpr int kNodes = 1050000;
    for (int i = 0; i < kNodes; ++i)
      nodes += std::to_string(kApart * (rising ? i : kNodes - i)) + " 0 0 0\n";
    const std::string text = "$NOD\n1050000\n" + nodes + "$ENDNOD\n";
    EXPECT_TRUE(test::contains(complaintOf("msh", text), "no tetrahedron"));
    EXPECT_TRUE(refused("msh", text));
  }
}

TEST(HostileMeshes, TagsThatFallAreFoundAndMayNotComeTwice) {
  const std::string element = "$ENDNOD\n$ELM\n1\n1 4 0 1 4 9 5 -7 20\n$ENDELM\n";
  const std::string nodes = "5 1 0 0\n-7 0 1 0\n20 0 0 1\n9 0 0 0\n";
  EXPECT_EQ(complaintOf("msh", "$NOD\n4\n" + nodes + element), "");
  for (const char* again : {"5", "-7", "20", "9"}) {
    EXPECT_TRUE(
        test::contains(complaintOf("msh", "$NOD\n5\n" + nodes + again + " 0 0 0\n" + element),
                       "must not come twice"));
  }
  EXPECT_TRUE(
      test::contains(complaintOf("msh", "$NOD\n3\n" + nodes.substr(8) + element), "node 5"));
}

TEST(HostileMeshes, UseMayNotRepeatWithoutEnd) {
  const std::string head = "#VRML V2.0 utf8\n";
  const std::string shape = "Shape { geometry DEF F IndexedFaceSet { coord Coordinate { point [" +
                            repeated("0 0 0 1 0 0 0 1 0 ", 10000) +
                            "] } coordIndex [0 1 2 -1] } }\n";
  EXPECT_EQ(complaintOf("wrl", head + shape + repeated("Shape { geometry USE F }\n", 20)), "");
  const std::string text = head + shape + repeated("Shape { geometry USE F }\n", 10000);
  EXPECT_TRUE(
      test::contains(complaintOf("wrl", text), "must not repeat more than 2000000 numbers"));
  EXPECT_TRUE(refused("wrl", text));
}

// What is chosen of many, or looked at once more, costs no more than itself.
TEST(HostileMeshes, NodesThatAreUsedOftenAreNotCopied) {
  const std::string head = "#VRML V2.0 utf8\n", many = repeated("Group {} ", 50000);
  const std::string use = repeated("USE A ", 50000);
  EXPECT_TRUE(
      refused("wrl", head + "DEF A Switch { whichChoice 0 choice [" + many + "] }\n" + use));
  EXPECT_TRUE(refused("wrl", head + "DEF A LOD { level [" + many + "] }\n" + use));
  const std::string points = "DEF A Coordinate { point [" + repeated("0 ", 60000) + "] }\n";
  EXPECT_TRUE(refused(
      "wrl", head + points + "Shape { geometry IndexedFaceSet { coord [" + use + "] } }\n"));
}

std::string vtuOf(const std::string& arrays, const std::string& points, int num_points,
                  const std::string& appended, const std::string& attributes) {
  return "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\"" + attributes +
         "><UnstructuredGrid><Piece NumberOfPoints=\"" + std::to_string(num_points) +
         "\" NumberOfCells=\"" + std::to_string(num_points) + "\"><Points>" + points +
         "</Points><Cells>" + arrays +
         "</Cells></Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_" + appended +
         "</AppendedData></VTKFile>";
}

std::string longs(const std::vector<std::uint64_t>& numbers) {
  std::string bytes;
  for (const std::uint64_t number : numbers) formats::put(&bytes, number);
  return bytes;
}

TEST(HostileMeshes, CompressedBlocksMayNotStandForMuchMore) {
  const std::string zeros(std::size_t{48} << 20, '\0');
  std::vector<Bytef> packed(compressBound(zeros.size()));
  uLongf length = packed.size();
  ASSERT_EQ(compress2(packed.data(), &length, reinterpret_cast<const Bytef*>(zeros.data()),
                      zeros.size(), 9),
            Z_OK);
  const std::string block = longs({1, zeros.size(), zeros.size(), length}) +
                            std::string(reinterpret_cast<const char*>(packed.data()), length);
  ASSERT_LT(block.size(), 100000U);
  const std::string array =
      "<DataArray type=\"Int8\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/>";
  const std::string text =
      vtuOf("", array, 1 << 24, block, " compressor=\"vtkZLibDataCompressor\"");
  EXPECT_TRUE(test::contains(complaintOf("vtu", text), "must not have more than"));
  EXPECT_TRUE(refused("vtu", text));
}

TEST(HostileMeshes, CompressedBlocksMayDeclareAnything) {
  const std::string array =
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/>";
  const std::uint64_t peta = std::uint64_t{1} << 50, most = ~std::uint64_t{0};
  for (const auto& header : std::vector<std::vector<std::uint64_t>>{{1, peta, peta, 8},
                                                                    {peta, 24, 24, 8},
                                                                    {1, 24, 24, peta},
                                                                    {2, 24, most - 23, 8, 8},
                                                                    {3, 24, most - 23, 8, 8, 8},
                                                                    {most, most, most, most},
                                                                    {1, 0, 0, 0},
                                                                    {2, 0, 24, 8, 8},
                                                                    {0, 0, 0},
                                                                    {1, 24, 24, most}}) {
    SCOPED_TRACE(header[0]);
    EXPECT_TRUE(refused("vtu", vtuOf("", array, 1, longs(header) + "12345678",
                                     " compressor=\"vtkZLibDataCompressor\"")));
  }
}

// A hundred bytes of XML name a block of a megabyte, a thousand times.
TEST(HostileMeshes, ArraysMayNotShareABlockWithoutEnd) {
  constexpr std::size_t n = std::size_t{1} << 17;
  const auto block = [](std::size_t bytes) { return longs({bytes}) + std::string(bytes, '\0'); };
  const std::string blocks = block(8 * n) + block(12 * n) + block(0);
  const auto array = [](const std::string& type, const std::string& name, int components,
                        std::size_t offset) {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
           std::to_string(components) + "\" format=\"appended\" offset=\"" +
           std::to_string(offset) + "\"/>";
  };
  const std::string cells = array("Float64", "types", 1, 0) + array("Float64", "offsets", 1, 0) +
                            array("Float64", "connectivity", 1, 20 * n + 16);
  const std::string points = array("Float32", "Points", 3, 8 * n + 8);
  const std::string good = vtuOf(cells, points, n, blocks, "");
  EXPECT_TRUE(test::contains(complaintOf("vtu", good), "there is no tetrahedron"));
  std::string text = good;
  text.insert(text.find("<Points>"),
              "<CellData>" + repeated(array("Float64", "a", 1, 0), 1000) + "</CellData>");
  EXPECT_TRUE(test::contains(complaintOf("vtu", text), "must not have more than"));
  EXPECT_TRUE(refused("vtu", text));
}

TEST(HostileMeshes, MayNotBeNestedWithoutEnd) {
  EXPECT_TRUE(refused("vtu", repeated("<a>", 100000)));
  EXPECT_TRUE(refused(
      "vtu", "<VTKFile type=\"UnstructuredGrid\">" + repeated("<UnstructuredGrid>", 100000)));
  EXPECT_TRUE(refused("wrl", "#VRML V2.0 utf8\n" + repeated("A { b ", 100000)));
}

}  // namespace
}  // namespace palpate::fuzz
