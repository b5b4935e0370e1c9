// SPDX-License-Identifier: GPL-3.0-or-later
// What it costs to hand a loop to the team and to wait for it.
#include <benchmark/benchmark.h>

#include "palpate/base/thread_pool.h"

namespace palpate::micro {
namespace {

void dispatch(benchmark::State& state) {
  ThreadPool pool(static_cast<int>(state.range(0)));
  std::size_t ends[64] = {};
  for (auto _ : state) {
    pool.forRanges(64, [&](std::size_t begin, std::size_t end) { ends[begin] = end; });
    benchmark::DoNotOptimize(ends);
  }
}
BENCHMARK(dispatch)
    ->Name("thread_pool_dispatch")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime();

}  // namespace
}  // namespace palpate::micro
