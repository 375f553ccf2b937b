// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/count_malloc.h"

#include <cerrno>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define POISE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define POISE_SANITIZED 1
#endif
#endif

namespace poise {
namespace {

thread_local bool g_counting = false;
thread_local int g_allocations = 0;

}  // namespace

CountMalloc::CountMalloc() {
  g_allocations = 0;
  g_counting = true;
}

CountMalloc::~CountMalloc() { g_counting = false; }

int CountMalloc::allocations() const { return g_allocations; }

#ifndef POISE_SANITIZED

bool CountMalloc::IsSupported() { return true; }

namespace {
void Count() {
  if (g_counting) ++g_allocations;
}
}  // namespace
}  // namespace poise

// These functions replace glibc's, which stay available under the names
// __libc_*.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* pointer, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  poise::Count();
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  poise::Count();
  return __libc_calloc(count, size);
}

void* realloc(void* pointer, std::size_t size) {
  poise::Count();
  return __libc_realloc(pointer, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  poise::Count();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** pointer, std::size_t alignment, std::size_t size) {
  poise::Count();
  *pointer = __libc_memalign(alignment, size);
  return *pointer == nullptr ? ENOMEM : 0;
}
}

#else

bool CountMalloc::IsSupported() { return false; }

}  // namespace poise

#endif
