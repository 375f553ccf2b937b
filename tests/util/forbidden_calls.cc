// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tests/util/forbidden_calls.h"

#include <dlfcn.h>
#include <pthread.h>
#include <sys/types.h>

#include <cstddef>
#include <typeinfo>

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
thread_local int g_throws = 0;
thread_local int g_locks = 0;
thread_local int g_writes = 0;

}  // namespace

ForbiddenCalls::ForbiddenCalls() {
  g_throws = g_locks = g_writes = 0;
  g_counting = true;
}

ForbiddenCalls::~ForbiddenCalls() { g_counting = false; }

int ForbiddenCalls::throws() const { return g_throws; }
int ForbiddenCalls::locks() const { return g_locks; }
int ForbiddenCalls::writes() const { return g_writes; }

#ifndef POISE_SANITIZED

bool ForbiddenCalls::IsSupported() { return true; }

namespace {

// The function of this name that this file's stands in front of.
template <typename Function>
Function* Next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace
}  // namespace poise

extern "C" {

[[noreturn]] void __cxa_throw(void* thrown, std::type_info* type,
                              void (*destroy)(void*)) {
  if (poise::g_counting) ++poise::g_throws;
  using Throw = void(void*, std::type_info*, void (*)(void*));
  poise::Next<Throw>("__cxa_throw")(thrown, type, destroy);
  __builtin_unreachable();
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  if (poise::g_counting) ++poise::g_locks;
  static auto* const next =
      poise::Next<int(pthread_mutex_t*)>("pthread_mutex_lock");
  return next(mutex);
}

ssize_t write(int file, const void* data, std::size_t size) {
  if (poise::g_counting) ++poise::g_writes;
  static auto* const next =
      poise::Next<ssize_t(int, const void*, std::size_t)>("write");
  return next(file, data, size);
}
}

#else

bool ForbiddenCalls::IsSupported() { return false; }

}  // namespace poise

#endif
