// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/forbidden_calls.h"

// With _FORTIFY_SOURCE, the headers would replace functions that this file
// defines.
#undef _FORTIFY_SOURCE

#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/types.h>
#include <sys/uio.h>

#include <cstdarg>
#include <cstddef>
#include <cstdio>
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

// Returns the original function that a function of this file replaces.
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

// Defines a C function that counts its calls and then calls the original.
#define POISE_COUNT(counter, result, name, parameters, arguments)    \
  result name parameters {                                           \
    if (poise::g_counting) ++poise::counter;                         \
    static auto* const next = poise::Next<result parameters>(#name); \
    return next arguments;                                           \
  }

POISE_COUNT(g_locks, int, pthread_mutex_lock, (pthread_mutex_t * lock), (lock))
POISE_COUNT(g_locks, int, pthread_mutex_trylock, (pthread_mutex_t * lock),
            (lock))
POISE_COUNT(g_locks, int, pthread_rwlock_rdlock, (pthread_rwlock_t * lock),
            (lock))
POISE_COUNT(g_locks, int, pthread_rwlock_wrlock, (pthread_rwlock_t * lock),
            (lock))
POISE_COUNT(g_locks, int, pthread_spin_lock, (pthread_spinlock_t * lock),
            (lock))
POISE_COUNT(g_locks, int, sem_wait, (sem_t * lock), (lock))

POISE_COUNT(g_writes, ssize_t, write,
            (int file, const void* data, std::size_t size), (file, data, size))
POISE_COUNT(g_writes, ssize_t, writev, (int file, const iovec* data, int count),
            (file, data, count))
POISE_COUNT(g_writes, std::size_t, fwrite,
            (const void* data, std::size_t size, std::size_t count, FILE* file),
            (data, size, count, file))
POISE_COUNT(g_writes, int, fputs, (const char* text, FILE* file), (text, file))
POISE_COUNT(g_writes, int, fputc, (int character, FILE* file),
            (character, file))
POISE_COUNT(g_writes, int, putc, (int character, FILE* file), (character, file))
POISE_COUNT(g_writes, int, puts, (const char* text), (text))
POISE_COUNT(g_writes, int, vfprintf,
            (FILE * file, const char* format, va_list list),
            (file, format, list))

#undef POISE_COUNT

int fprintf(FILE* file, const char* format, ...) {
  va_list list;
  va_start(list, format);
  const int result = vfprintf(file, format, list);
  va_end(list);
  return result;
}

int printf(const char* format, ...) {
  va_list list;
  va_start(list, format);
  const int result = vfprintf(stdout, format, list);
  va_end(list);
  return result;
}
}

#else

bool ForbiddenCalls::IsSupported() { return false; }

}  // namespace poise

#endif
