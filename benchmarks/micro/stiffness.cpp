// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix times vector, and beside it the speed at which this core reads as many bytes.
#include <cstdint>
#include <string>
#include <vector>

#include "body.h"

namespace palpate::micro {
namespace {

// What a product must move at least, as the matrix is stored: blocks with their column, vectors.
double bytesOf(const fem::Stiffness& K) {
  const double block = 9 * sizeof(double) + sizeof(int);
  const double node = 6 * sizeof(double) + sizeof(int);
  double bytes = block * K.blocks().numBlocks() + node * K.numNodes();
  if (K.hasVolume()) {
    bytes += static_cast<double>(K.volume().rows.cols()) * (3 * sizeof(double) + sizeof(int));
  }
  return bytes;
}

void multiply(benchmark::State& state, const std::string& element, int cells) {
  const Body body(cells, element, "stable_neo_hookean");
  const fem::Stiffness K = stepMatrix(body);
  Points y(3, body.mesh.numPoints());
  K.multiply(body.x, &y);
  for (auto _ : state) {
    K.multiply(body.x, &y);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
  countTets(state, body);
  state.SetBytesProcessed(
      static_cast<std::int64_t>(bytesOf(K) * static_cast<double>(state.iterations())));
}

// Whole numbers, so that the compiler may add them in any order.
#if defined(__x86_64__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
std::uint64_t
sum(const std::uint64_t* data, std::size_t count) {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < count; ++i) total += data[i];
  return total;
}

void read(benchmark::State& state, const std::string& element, int cells) {
  const Body body(cells, element, "stable_neo_hookean");
  const auto count = static_cast<std::size_t>(bytesOf(stepMatrix(body)) / sizeof(std::uint64_t));
  const std::vector<std::uint64_t> data(count, 1);
  for (auto _ : state) benchmark::DoNotOptimize(sum(data.data(), count));
  state.SetBytesProcessed(static_cast<std::int64_t>(count * sizeof(std::uint64_t)) *
                          state.iterations());
}

const bool kAdded = [] {
  for (const char* element : {"tet4", "anp"}) {
    for (const int cells : {9, 15, 20}) {
      const std::string of =
          std::string("/") + element + "/tets:" + std::to_string(6 * cells * cells * cells);
      benchmark::RegisterBenchmark(("multiply" + of).c_str(), [=](benchmark::State& state) {
        multiply(state, element, cells);
      })->Unit(benchmark::kMicrosecond);
      benchmark::RegisterBenchmark(("read" + of).c_str(), [=](benchmark::State& state) {
        read(state, element, cells);
      })->Unit(benchmark::kMicrosecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace palpate::micro
