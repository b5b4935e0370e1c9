// SPDX-License-Identifier: GPL-3.0-or-later
// The program prints the names of a cached mesh and a cached grid where it is asked to.
#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <string_view>

#include "mesh/cache_file.h"
#include "mesh/surfaces.h"
#include "palpate/base/rounding.h"
#include "palpate/mesh/distance_grid_cache.h"
#include "palpate/mesh/mesh_cache.h"
#include "support/contains.h"
#include "support/own_program.h"

namespace palpate::mesh {
namespace {

constexpr char kPrint[] = "--print-rounding-and-names";

std::string names() {
  MeshingOptions options;
  options.edge_length.coarsest = 0.04;
  const SurfaceMesh surface = boxSurface(0.1, 1);
  return cacheFile(surface, options, "") + " " + cacheFile(surface, DistanceGridSettings{}, "");
}

std::string after(const std::string& text, char separator) {
  return text.substr(text.find(separator) + 1);
}

// What the mesher makes depends on angles that the C library computes.
TEST(CacheKeys, AreOthersWhereTheProcessRoundsOtherwise) {
  const std::string own = test::runThisProgram(test::kOwnKernels, kPrint),
                    oldest = test::runThisProgram(test::kOldestKernels, kPrint);
  EXPECT_EQ(test::runThisProgram(test::kOwnKernels, kPrint), own);
  if (own.substr(0, own.find('\n')) == oldest.substr(0, oldest.find('\n'))) {
    GTEST_SKIP() << "the C library of this machine has one variant of its functions";
  }
  const std::string of_own = after(own, '\n'), of_oldest = after(oldest, '\n');
  EXPECT_NE(of_own.substr(0, of_own.find(' ')), of_oldest.substr(0, of_oldest.find(' ')));
  EXPECT_NE(after(of_own, ' '), after(of_oldest, ' '));
}

TEST(CacheKeys, NameTheMesherAndTheRounding) {
  EXPECT_TRUE(test::contains(makerOfGeometry(), "CGAL 10"));
  EXPECT_TRUE(test::contains(makerOfGeometry(), rounding()));
}

}  // namespace
}  // namespace palpate::mesh

int main(int argc, char** argv) {
  using namespace palpate;
  if (argc == 2 && std::string_view(argv[1]) == mesh::kPrint) {
    std::cout << rounding() << "\n" << mesh::names();
    return 0;
  }
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
