// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix times vector, as it is stored and as conjugate gradients have it, and beside each the
// speed at which this core reads as many bytes.
#include <cstdint>
#include <string>
#include <vector>

#include "body.h"
#include "solver/pcg_matrix.h"

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

// Conjugate gradients' own matrix and vectors, single precision.
struct Packed {
  explicit Packed(const fem::Stiffness& A) {
    matrix.assign(A);
    lanes = static_cast<std::size_t>(solver::kSlice) * matrix.nodes().numSlices();
    p.assign(3 * lanes, 1.0);
    Ap.assign(3 * lanes, 0.0F);
    p_nodes.assign(solver::kNodeStride * lanes, 1.0F);
    v = {nullptr, nullptr, p.data(), nullptr, Ap.data(), p_nodes.data()};
  }
  double bytes() const {
    const double vectors = 3 * sizeof(double) + (solver::kNodeStride + 3) * sizeof(float);
    return static_cast<double>(matrix.bytes()) + vectors * static_cast<double>(lanes);
  }

  solver::PcgMatrix matrix{nullptr, bestIsa(), Points()};
  std::size_t lanes;
  solver::AlignedVector<double> p;
  solver::AlignedVector<float> Ap, p_nodes;
  solver::PcgVectors v{};
};

void product(benchmark::State& state, const std::string& element, int cells) {
  const Body body(cells, element, "stable_neo_hookean");
  Packed packed(stepMatrix(body));
  for (auto _ : state) benchmark::DoNotOptimize(packed.matrix.apply(packed.v));
  countTets(state, body);
  state.SetBytesProcessed(
      static_cast<std::int64_t>(packed.bytes() * static_cast<double>(state.iterations())));
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

void read(benchmark::State& state, const std::string& element, int cells, bool packed) {
  const Body body(cells, element, "stable_neo_hookean");
  const fem::Stiffness A = stepMatrix(body);
  const auto count =
      static_cast<std::size_t>((packed ? Packed(A).bytes() : bytesOf(A)) / sizeof(std::uint64_t));
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
      benchmark::RegisterBenchmark(("product" + of).c_str(), [=](benchmark::State& state) {
        product(state, element, cells);
      })->Unit(benchmark::kMicrosecond);
      for (const bool packed : {false, true}) {
        const std::string name = (packed ? "read_as_product" : "read") + of;
        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
          read(state, element, cells, packed);
        })->Unit(benchmark::kMicrosecond);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace palpate::micro
