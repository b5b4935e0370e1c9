// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "palpate/base/thread_pool.h"

namespace palpate {

/// Calls body(begin, end) on parts of [0, count), by the pool if it is not null.
template <class Body>
void forAll(ThreadPool* pool, std::size_t count, const Body& body) {
  if (pool) {
    pool->forRanges(count, body);
  } else {
    body(std::size_t{0}, count);
  }
}

}  // namespace palpate
