// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged files of every format: either an InputError or a valid mesh, never anything else.
#include <gtest/gtest.h>

#include <random>

#include "formats/surface_formats.h"
#include "formats/surface_samples.h"
#include "formats/tet_formats.h"
#include "formats/tet_samples.h"
#include "palpate/base/error.h"
#include "palpate/formats/tet_io.h"
#include "palpate/formats/vtu_writer.h"
#include "support/temp_folder.h"

namespace palpate::formats::mesh_io_robustness_test {
namespace {

void expectValid(const mesh::SurfaceMesh& surface) {
  ASSERT_GT(surface.triangles.cols(), 0);
  EXPECT_TRUE(surface.points.allFinite());
  EXPECT_GE(surface.triangles.minCoeff(), 0);
  EXPECT_LT(surface.triangles.maxCoeff(), surface.points.cols());
}

void expectValid(const mesh::TetMesh& mesh) {
  ASSERT_GT(mesh.numTets(), 0);
  EXPECT_TRUE(mesh.points.allFinite());
  EXPECT_GE(mesh.tets.minCoeff(), 0);
  EXPECT_LT(mesh.tets.maxCoeff(), mesh.numPoints());
  if (mesh.quadratic()) {
    EXPECT_EQ(mesh.midnodes.cols(), mesh.numTets());
    EXPECT_GE(mesh.midnodes.minCoeff(), 0);
    EXPECT_LT(mesh.midnodes.maxCoeff(), mesh.numPoints());
  }
  EXPECT_TRUE(mesh.region.empty() ||
              static_cast<Eigen::Index>(mesh.region.size()) == mesh.numTets());
  EXPECT_NO_THROW(checkTets(mesh, "read back"));
}

bool isSurface(const Sample& sample) {
  for (const Sample& s : surfaceSamples()) {
    if (s.extension == sample.extension) return true;
  }
  return false;
}

/// True if the damaged file is accepted. In memory: there are a hundred thousand of them.
bool readDamaged(const Sample& sample, const std::string& bytes) {
  const std::string file = "damaged" + sample.extension;
  try {
    if (isSurface(sample)) {
      expectValid(parseSurface(file, bytes));
    } else {
      expectValid(parseTetMesh(file, bytes));
    }
    return true;
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), file);
    EXPECT_FALSE(error.problems().empty());
    return false;
  }  // any other exception fails the test
}

std::vector<Sample> allSamples() {
  std::vector<Sample> all = surfaceSamples();
  for (const Sample& sample : tetSamples()) all.push_back(sample);
  return all;
}

class DamagedFile : public testing::TestWithParam<Sample> {};

TEST_P(DamagedFile, EveryPrefix) {
  const Sample& sample = GetParam();
  int accepted = 0;
  for (std::size_t n = 0; n < sample.bytes.size(); ++n) {
    SCOPED_TRACE(n);
    accepted += readDamaged(sample, sample.bytes.substr(0, n)) ? 1 : 0;
  }
  // What can be seen is seen: half a file is never taken for a whole one, but where the format
  // says no number beforehand.
  EXPECT_TRUE(readDamaged(sample, sample.bytes));
  if (sample.extension != ".obj") {
    EXPECT_FALSE(readDamaged(sample, sample.bytes.substr(0, sample.bytes.size() / 2)));
  }
  EXPECT_LT(accepted, 90) << "of " << sample.bytes.size();
}

TEST_P(DamagedFile, ChangedBytes) {
  const Sample& sample = GetParam();
  std::mt19937 rng(20240229);  // fixed: a failure must repeat
  const auto draw = [&](std::size_t n) { return static_cast<std::size_t>(rng() % n); };
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    std::string bytes = sample.bytes;
    for (std::size_t k = 1 + draw(4); k > 0; --k) {
      const std::size_t at = draw(bytes.size());
      switch (draw(4)) {
        case 0:
          bytes[at] = static_cast<char>(rng());
          break;
        case 1:
          bytes[at] = "0123456789-. \neE#{}[]\"<>/$"[draw(26)];
          break;
        case 2:
          bytes.erase(at, 1 + draw(8));
          break;
        default:
          bytes.insert(at, bytes.substr(draw(bytes.size()), 1 + draw(16)));
      }
      if (bytes.empty()) bytes = "x";
    }
    readDamaged(sample, bytes);
  }
}

TEST_P(DamagedFile, Garbage) {
  std::mt19937 rng(7);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    // Behind a good beginning of some length, so that more than the header check is met.
    std::string bytes = GetParam().bytes.substr(0, rng() % 200);
    for (unsigned n = 1 + rng() % 2000; n > 0; --n) bytes.push_back(static_cast<char>(rng()));
    readDamaged(GetParam(), bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFile, testing::ValuesIn(allSamples()),
                         [](const auto& sample) { return sample.param.name; });

TEST(WrittenVtu, EveryPrefix) {
  const test::TempFolder dir;
  writeVtu(dir.path("a.vtu"), mesh::boxMesh(Vec3(1, 1, 1), Eigen::Vector3i(1, 1, 1)), {}, {});
  const Sample sample{"written", ".vtu", test::fileBytes(dir.path("a.vtu"))};
  for (std::size_t n = 0; n < sample.bytes.size(); ++n) {
    SCOPED_TRACE(n);
    readDamaged(sample, sample.bytes.substr(0, n));
  }
}

}  // namespace
}  // namespace palpate::formats::mesh_io_robustness_test
