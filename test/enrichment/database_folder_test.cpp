// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/database_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "palpate/mesh/surface_levels.h"
#include "palpate/organs/organs.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::enrichment::database_folder_test {
namespace {

struct Body {
  mesh::SurfaceMesh coarse = organs::makeOrgan("slab", 0.03), fine = mesh::splitTriangles(coarse);

  Deformation sample(int k) const {
    Deformation sample;
    sample.contact = k;
    sample.force = Vec3(0.0, 0.1 * k, -1.0);
    sample.fine = fine.points * (1e-3 * k);
    return sample;
  }
};

TEST(DatabaseFolder, ReadsWhatWasWrittenInTheOrderOfNumbersWithoutWhatWasNotSolved) {
  const test::TempFolder temp;
  const Body body;
  const std::string folder = temp.path("data");
  for (const int part : {1, 0}) {  // as two programs would
    const DatabaseFolder out(folder, body.coarse, body.fine, "E = 1");
    for (int k = part; k < 12; k += 2) {
      EXPECT_FALSE(out.has(k));
      out.write(k, body.sample(k), k != 5);
      EXPECT_TRUE(out.has(k));
    }
  }
  int unsolved = 0;
  const DeformationDatabase database = readDatabase(folder, &unsolved);
  EXPECT_EQ(unsolved, 1);
  EXPECT_EQ(database.coarse.points, body.coarse.points);
  EXPECT_EQ(database.fine.triangles, body.fine.triangles);
  ASSERT_EQ(database.samples.size(), 11U);
  EXPECT_EQ(database.samples[5].contact, 6);
  EXPECT_EQ(database.samples[5].force, body.sample(6).force);
  EXPECT_EQ(database.samples[5].fine, body.sample(6).fine);
}

TEST(DatabaseFolder, RefusesSamplesOfAnotherBodyOrAskedForOtherwise) {
  const test::TempFolder temp;
  Body body;
  const std::string folder = temp.path("data");
  DatabaseFolder(folder, body.coarse, body.fine, "E = 1").write(0, body.sample(0), true);
  EXPECT_THROW(DatabaseFolder(folder, body.coarse, body.fine, "E = 2"), InputError);
  body.fine.points(0, 3) += 1e-9;
  EXPECT_THROW(DatabaseFolder(folder, body.coarse, body.fine, "E = 1"), InputError);
  const DatabaseFolder other(temp.path("other"), body.coarse, body.fine, "E = 1");
  other.write(1, body.sample(1), true);
  std::filesystem::copy_file(temp.path("other/sample_000001.bin"),
                             temp.path("data/sample_000001.bin"));
  EXPECT_THROW(readDatabase(folder), InputError);
}

TEST(DatabaseFolder, RefusesWhatIsNoDatabaseAndFilesThatAreCutOffAnywhere) {
  const test::TempFolder temp;
  const Body body;
  EXPECT_THROW(readDatabase(temp.path("")), InputError);
  EXPECT_THROW(readDatabase(temp.path("nowhere")), InputError);
  const std::string folder = temp.path("data");
  DatabaseFolder(folder, body.coarse, body.fine, "").write(0, body.sample(0), true);
  for (const char* name : {"data/body.bin", "data/sample_000000.bin"}) {
    const std::string whole = test::fileBytes(temp.path(name));
    for (std::size_t k = 0; k < whole.size(); k += whole.size() / 37 + 1) {
      temp.write(name, whole.substr(0, k));
      EXPECT_THROW(readDatabase(folder), InputError) << name << " " << k;
    }
    temp.write(name, whole + "x");
    EXPECT_THROW(readDatabase(folder), InputError) << name;
    temp.write(name, whole);
    EXPECT_EQ(readDatabase(folder).samples.size(), 1U);
  }
}

TEST(DatabaseFolder, RefusesForcesThatAreNotFinite) {
  const test::TempFolder temp;
  const Body body;
  const std::string folder = temp.path("data");
  const DatabaseFolder out(folder, body.coarse, body.fine, "");
  Deformation sample = body.sample(0);
  sample.force.y() = std::numeric_limits<double>::quiet_NaN();
  out.write(0, sample, false);  // as one that was not solved it is nobody's
  EXPECT_NO_THROW(readDatabase(folder));
  out.write(1, sample, true);
  EXPECT_THROW(readDatabase(folder), InputError);
}

}  // namespace
}  // namespace palpate::enrichment::database_folder_test
