// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of .msh files that are wrong, of each version of the format.
#include <gtest/gtest.h>

#include <map>

#include "formats/refusals.h"
#include "formats/tet_formats.h"
#include "formats/tet_samples.h"

namespace palpate::formats::gmsh_errors_test {
namespace {

const std::string kFormat2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

void expectOfMsh(const std::string& good, const std::vector<Spoiling>& spoilings) {
  expectRefusals(parseTetMesh, "a.msh", good, spoilings);
}

/// Where a binary file's data begins behind the line `before`.
std::size_t behind(const std::string& bytes, const std::string& before) {
  EXPECT_TRUE(test::contains(bytes, before));
  return bytes.find(before) + before.size();
}
std::string atByte(std::size_t position) { return "byte " + std::to_string(position); }

TEST(GmshErrors, OfTheFormatLine) {
  expectOfMsh(msh2Sample(),
              {{"2.2 0 8", "2.2 2 8", "line 2 = 2: the file type must be 0 or 1"},
               {"2.2 0 8", "2.2 0 4", "line 2 = 4: the data size must be 8"},
               {"2.2 0 8", "4.1 0 5", "line 2 = 5: the data size must be 8"},
               {"2.2 0 8", "2.2 0 4294967304", "line 2 = 4294967304: is too large: data size"},
               {"2.2 0 8", "two 0 8", "line 2 = two: must be a number: version"},
               {"$EndMeshFormat", "$Nodes", "line 3 = $Nodes: must be '$EndMeshFormat'"}});
  expectRefusals(parseTetMesh, "a.msh",
                 {{"$MeshFormat\n2.2 0 8\n", "line 3: truncated: '$EndMeshFormat' must follow"},
                  {"$MeshFormat\n", "line 2: ends where a number is expected: version"}});
}

TEST(GmshErrors, OfTheByteOrder) {
  const std::string bytes = msh2BinarySample(false);
  const std::size_t at = behind(bytes, "$MeshFormat\n2.2 1 8\n");
  expectRefusals(
      parseTetMesh, "a.msh",
      {{std::string(bytes).replace(at, 4, packed<int>({2})),
        atByte(at) + ": a binary file must have the integer 1 here"},
       {bytes.substr(0, at + 3),
        atByte(at) + ": truncated: the number 1 of a binary file takes 4 bytes, there are 3"}});
}

TEST(GmshErrors, OfSections) {
  expectOfMsh(
      msh2Sample(),
      {{kFormat2, "", "line 5 = $Nodes: must stand behind $MeshFormat"},
       {"$Nodes", "$NOD", "line 8 = $NOD: no section of version 2"},
       {"$Nodes", "$Entities", "line 8 = $Entities: no section of version 2"},
       {"$Nodes", "Nodes", "line 8 = Nodes: must be the name of a section: $MeshFormat, $NOD, ..."},
       {"$EndPhysicalNames", "$EndNames", "line 4: truncated: '$EndPhysicalNames' must follow"}});
}

TEST(GmshErrors, OfElements) {
  const std::string no_type = ": must be one of Gmsh's 1 to 31, 92, 93";
  const std::string no_tetrahedron =
      ": volume elements must be tetrahedra with 4 nodes (type 4) or 10 nodes (type 11)";
  const std::string triangle = "1 2 2 1 1 10 40 30";
  std::vector<Spoiling> spoilings = {
      {"2 4 2 7 1", "2 4 -2 7 1",
       "line 20 = -2: must not be negative: number of an element's tags"},
      {"2 4 2 7 1 10 30 40 50", "2 4 999 7 1",
       "line 20 = 999: truncated or wrong number of an element's tags: only 40 bytes follow"},
      {"2 4 2 7 1", "2 4 2 2147483648 1", "line 20 = 2147483648: is too large: tag of an element"}};
  for (const std::string type : {"-1", "0", "32", "94"}) {
    spoilings.push_back({triangle, "1 " + type + " 0", "line 19 = element type " + type + no_type});
  }
  const std::map<int, int> nodes = {{5, 8}, {31, 56}, {92, 64}, {93, 125}};  // by type
  for (const auto& [type, num_nodes] : nodes) {
    std::string element = "1 " + std::to_string(type) + " 0";
    for (int i = 0; i < num_nodes; ++i) element += " 10";
    spoilings.push_back(
        {triangle, element, "line 19 = element type " + std::to_string(type) + no_tetrahedron});
  }
  expectOfMsh(msh2Sample(), spoilings);
}

TEST(GmshErrors, OfVersion1) {
  expectOfMsh(msh1Sample(), {{"2 4 7 1", "2 4 2147483648 1",
                              "line 13 = 2147483648: is too large: physical tag of an element"},
                             {"2 4 7 1", "2 4 7 x",
                              "line 13 = x: must be a whole number: elementary tag of an element"},
                             {"2 4 7 1 4", "2 44 7 1 4",
                              "line 13 = element type 44: must be one of Gmsh's 1 to 31, 92, 93"}});
  expectRefusals(
      parseTetMesh, "a.msh",
      {{"$NOD\n1\n10 0 0", "line 3: ends where a number is expected: z of a node"},
       {"$NOD\n1\n", "line 3: ends where a whole number is expected: tag of a node"},
       {"$NOD\n0\n$ENDNOD\n$ELM\n-1\n", "line 5 = -1: must not be negative: number of elements"}});
}

TEST(GmshErrors, OfBlocksInBinaryVersion2) {
  for (const bool big : {false, true}) {
    const std::string bytes = msh2BinarySample(big);
    const std::size_t at = behind(bytes, "$Elements\n3\n");  // type, elements in it, tags
    const auto block = [&](int type, int elements, int tags) {
      const std::vector<double> head = {double(type), double(elements), double(tags)};
      return std::string(bytes).replace(at, 12, packed<int>(head, big));
    };
    expectRefusals(parseTetMesh, "a.msh",
                   {{block(2, 0, 2), atByte(at + 8) + " = 0 elements in a block: must be 1 ... 3"},
                    {block(2, 4, 2), atByte(at + 8) + " = 4 elements in a block: must be 1 ... 3"},
                    {block(2, 1, -1),
                     atByte(at + 8) + " = -1: must not be negative: number of an element's tags"}});
  }
}

TEST(GmshErrors, OfEntitiesNodesAndElementsInVersion4) {
  expectOfMsh(
      msh4Sample(),
      {{"1 0 1 2\n", "1 0 -1 2\n", "line 5 = -1: must not be negative: number of entities"},
       {"3 1 0 5", "4 1 0 5", "line 16 = 4: the dimension of an entity must be 0 ... 3"},
       {"3 1 0 5", "-1 1 0 5", "line 16 = -1: the dimension of an entity must be 0 ... 3"},
       {"2 6 10 60", "2 5 10 60", "line 16 = 5: more nodes than the section announced"},
       {"2 6 10 60", "2 7 10 60", "line 26 = 1 nodes: fewer than the section announced"},
       {"3 3 1 3", "3 4 1 4", "line 35 = 1 elements: fewer than the section announced"},
       {"3 9 4 1\n", "3 9 44 1\n",
        "line 34 = element type 44: must be one of Gmsh's 1 to 31, 92, 93"},
       {"3 9 4 1\n", "4 9 4 1\n", "line 34 = 4: the dimension of an entity must be 0 ... 3"},
       {"3 30 40 50 60", "3 30 40 50 61",
        "line 35 = node 61: an element has a node that is not in the file"}});
}

TEST(GmshErrors, OfCountsInBinaryVersion4) {
  for (const bool big : {false, true}) {
    const std::string bytes = msh4BinarySample(big);
    const std::size_t at = behind(bytes, "$Entities\n");
    const auto points = [&](double count) {
      return std::string(bytes).replace(at, 8, packed<long long>({count}, big));
    };
    const std::string too_many = " = 1000: truncated or wrong number of entities: only " +
                                 std::to_string(bytes.size() - at - 8) + " bytes follow";
    expectRefusals(parseTetMesh, "a.msh",
                   {{points(-1), atByte(at) + " = -1: must not be negative: number of entities"},
                    {points(1000), atByte(at) + too_many},
                    {bytes.substr(0, at + 5),
                     atByte(at) + ": truncated: number of entities takes 8 bytes, there are 5"}});
  }
}

}  // namespace
}  // namespace palpate::formats::gmsh_errors_test
