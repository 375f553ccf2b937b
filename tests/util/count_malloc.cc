// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/count_malloc.h"

#include <malloc.h>

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
thread_local long g_bytes = 0;

}  // namespace

CountMalloc::CountMalloc() {
  g_allocations = 0;
  g_bytes = 0;
  g_counting = true;
}

CountMalloc::~CountMalloc() { g_counting = false; }

int CountMalloc::allocations() const { return g_allocations; }

long CountMalloc::bytes() const { return g_bytes; }

#ifndef POISE_SANITIZED

bool CountMalloc::IsSupported() { return true; }

namespace {

long Size(void* block) { return static_cast<long>(malloc_usable_size(block)); }

// Counts a new block, and returns it.
void* Count(void* block) {
  if (g_counting) {
    ++g_allocations;
    g_bytes += Size(block);
  }
  return block;
}

// Counts a block that is about to be freed.
void CountFreed(void* block) {
  if (g_counting) g_bytes -= Size(block);
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
void __libc_free(void* pointer);

void* malloc(std::size_t size) { return poise::Count(__libc_malloc(size)); }

void* calloc(std::size_t count, std::size_t size) {
  return poise::Count(__libc_calloc(count, size));
}

void* realloc(void* pointer, std::size_t size) {
  poise::CountFreed(pointer);
  return poise::Count(__libc_realloc(pointer, size));
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return poise::Count(__libc_memalign(alignment, size));
}

int posix_memalign(void** pointer, std::size_t alignment, std::size_t size) {
  *pointer = poise::Count(__libc_memalign(alignment, size));
  return *pointer == nullptr ? ENOMEM : 0;
}

void free(void* pointer) {
  poise::CountFreed(pointer);
  __libc_free(pointer);
}
}

#else

bool CountMalloc::IsSupported() { return false; }

}  // namespace poise

#endif
