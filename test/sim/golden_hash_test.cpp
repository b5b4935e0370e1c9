// SPDX-License-Identifier: GPL-3.0-or-later
// The state that each shipped scene has after the first part of its trajectory, to the bit: a
// change of bits is a decision. Who makes it runs this program, in the environment of
// scripts/env.sh, with PALPATE_WRITE_HASHES=$PWD/test/sim/golden_hashes.csv and commits the file.
//
// Our kernels round alike on every processor; the C library's functions and BLAS choose others on
// another one, so the program starts anew where both take those that any x86-64 processor since
// 2008 has. Each hash stands beside that of their answers: versions of theirs that round otherwise
// are left out.
#include <gtest/gtest.h>

#include <dlfcn.h>
#include <stdlib.h>  // setenv: POSIX
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/sim/state_hash.h"
#include "sim/shipped_scenes.h"
#include "support/source_folder.h"

namespace palpate::sim {
namespace {

std::string hex(std::uint64_t value) {
  std::ostringstream text;
  text << std::hex << value;
  return text.str();
}

// A product by the BLAS that CHOLMOD has loaded.
void addProduct(std::vector<double>* values) {
  using Dgemm = void (*)(const char*, const char*, const int*, const int*, const int*,
                         const double*, const double*, const int*, const double*, const int*,
                         const double*, double*, const int*);
  const auto dgemm = reinterpret_cast<Dgemm>(dlsym(RTLD_DEFAULT, "dgemm_"));
  if (dgemm == nullptr) return;
  constexpr int kSize = 150, kDepth = 1000;  // deeper than its blocks, whose size differs too
  std::vector<double> A(kSize * kDepth), C(kSize * kSize, 0.0);
  for (std::size_t k = 0; k < A.size(); ++k) A[k] = std::sin(static_cast<double>(k));
  const double one = 1.0, zero = 0.0;
  dgemm("N", "T", &kSize, &kSize, &kDepth, &one, A.data(), &kSize, A.data(), &kSize, &zero,
        C.data(), &kSize);
  values->insert(values->end(), C.begin(), C.end());
}

// What OpenBLAS calls the processor that it computes for; "" of another BLAS.
std::string blasKernels() {
  using Name = char* (*)();
  const auto name = reinterpret_cast<Name>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  return name == nullptr ? std::string() : std::string(name());
}

// Of what others compute for us.
std::string roundingOfThisMachine() {
  StateHash hash;
  std::vector<double> values;
  for (int k = 1; k <= 500; ++k) {
    const double x = 0.0137 * k;
    for (const double y : {std::exp(-x), std::log(x), std::pow(x, 1.7), std::sin(x), std::cos(x),
                           std::atan2(x, 3.0), std::cbrt(x), std::hypot(x, 0.3)}) {
      values.push_back(y);
    }
  }
  addProduct(&values);
  for (const char c : blasKernels()) values.push_back(c);
  hash.add(values.data(), values.size());
  return hex(hash.value());
}

std::string hashAtTheEnd(const std::string& name) { return hex(test::hashesOf(name).back()); }

const std::string kFile = palpate::test::sourceFolder() + "/test/sim/golden_hashes.csv";

// From "rounding,scene" to its hash.
std::map<std::string, std::string> readHashes(const std::string& file) {
  std::map<std::string, std::string> all;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t comma = line.rfind(',');
    if (comma != std::string::npos) all[line.substr(0, comma)] = line.substr(comma + 1);
  }
  return all;
}

bool writeHashes(const std::string& file, const std::map<std::string, std::string>& all) {
  std::ofstream out(file);
  out << "rounding,scene,hash\n";
  for (const auto& [key, hash] : all) {
    if (key != "rounding,scene") out << key << "," << hash << "\n";
  }
  return static_cast<bool>(out.flush());
}

class GoldenHash : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, GoldenHash, ::testing::ValuesIn(test::shippedScenes()),
                         [](const auto& name) { return name.param; });

TEST_P(GoldenHash, IsThatOfTheFile) {
  const std::string key = roundingOfThisMachine() + "," + GetParam();
  std::map<std::string, std::string> golden = readHashes(kFile);
  if (const char* file = std::getenv("PALPATE_WRITE_HASHES")) {
    golden = readHashes(file);
    golden[key] = hashAtTheEnd(GetParam());
    ASSERT_TRUE(writeHashes(file, golden)) << file;
    return;
  }
  const std::string rounding = key.substr(0, key.find(','));
  const bool known = std::any_of(golden.begin(), golden.end(), [&](const auto& entry) {
    return entry.first.compare(0, rounding.size(), rounding) == 0;
  });
  if (!known)
    GTEST_SKIP() << "this C library or BLAS rounds as no line of " << kFile
                 << " says: " << rounding;
  ASSERT_TRUE(golden.count(key)) << "a scene without a hash: run with PALPATE_WRITE_HASHES="
                                 << kFile;
  EXPECT_EQ(hashAtTheEnd(GetParam()), golden[key]);
}

// Whether it had another value.
bool setTo(const char* name, const char* value) {
  const char* before = getenv(name);
  return (before == nullptr || std::string_view(before) != value) && setenv(name, value, 1) == 0;
}

}  // namespace
}  // namespace palpate::sim

int main(int argc, char** argv) {
  using palpate::sim::setTo;
  const bool blas = setTo("OPENBLAS_CORETYPE", "NEHALEM");
  const bool c_library = setTo("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4");
  if (blas || c_library) execv("/proc/self/exe", argv);  // both are read before main()
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
