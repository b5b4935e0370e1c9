// SPDX-License-Identifier: GPL-3.0-or-later
#include "heap_peak.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cerrno>

namespace {

std::atomic<bool> counting{false};
std::atomic<std::ptrdiff_t> now{0}, most{0};

void took(std::size_t bytes) {
  if (!counting.load(std::memory_order_relaxed)) return;
  const std::ptrdiff_t sum = now += static_cast<std::ptrdiff_t>(bytes);
  std::ptrdiff_t before = most.load(std::memory_order_relaxed);
  while (sum > before && !most.compare_exchange_weak(before, sum)) {
  }
}

void gave(std::size_t bytes) {
  if (counting.load(std::memory_order_relaxed)) now -= static_cast<std::ptrdiff_t>(bytes);
}

}  // namespace

#if defined(__SANITIZE_ADDRESS__)
#define PALPATE_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PALPATE_SANITIZED
#endif
#endif

extern "C" {
#ifdef PALPATE_SANITIZED

std::size_t __sanitizer_get_allocated_size(const volatile void* pointer);
void __sanitizer_malloc_hook(const volatile void* pointer, std::size_t size) {
  if (pointer != nullptr) took(size);
}
void __sanitizer_free_hook(const volatile void* pointer) {
  if (pointer != nullptr && counting) gave(__sanitizer_get_allocated_size(pointer));
}

#else

// The C library's own functions under their other names [glibc].
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* pointer, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* pointer);

static void* noted(void* pointer) {
  if (pointer != nullptr && counting) took(malloc_usable_size(pointer));
  return pointer;
}

void* malloc(std::size_t size) { return noted(__libc_malloc(size)); }
void* calloc(std::size_t number, std::size_t size) { return noted(__libc_calloc(number, size)); }
void* realloc(void* pointer, std::size_t size) {
  if (pointer != nullptr && counting) gave(malloc_usable_size(pointer));
  return noted(__libc_realloc(pointer, size));
}
void* memalign(std::size_t alignment, std::size_t size) {
  return noted(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** pointer, std::size_t alignment, std::size_t size) {
  *pointer = memalign(alignment, size);
  return *pointer ? 0 : ENOMEM;
}
void free(void* pointer) {
  if (pointer != nullptr && counting) gave(malloc_usable_size(pointer));
  __libc_free(pointer);
}

#endif
}

namespace palpate::test {

HeapPeak::HeapPeak() {
  now = most = 0;
  counting = true;
}
HeapPeak::~HeapPeak() { counting = false; }
std::size_t HeapPeak::bytes() const { return static_cast<std::size_t>(most.load()); }

}  // namespace palpate::test
