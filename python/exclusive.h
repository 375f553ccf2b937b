// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <stdexcept>
#include <string>
#include <thread>

namespace poise {

/// Marks an object as in use while a call runs without Python's global lock
/// (GIL). The flag is read and written with the lock held only, so a second
/// thread that uses the object meanwhile gets an error instead of torn data.
class InUse {
 public:
  /// Throws std::runtime_error, a RuntimeError in Python, if the object is in
  /// use: by another thread, or by this thread, whose tick calls a task that is
  /// written in Python.
  void Check(const char* what) const {
    if (!is_set_) return;
    throw std::runtime_error(
        std::string(what) +
        (user_ == std::this_thread::get_id()
             ? " is in a tick: rows() must use its input"
             : " is in use by another thread: give each thread its own"));
  }

  bool is_set() const { return is_set_; }

 private:
  friend class Exclusive;
  bool is_set_ = false;
  std::thread::id user_;
};

/// Sets the mark of an object during its life. Make it before the lock is
/// released; it must end after the lock is taken again.
class Exclusive {
 public:
  Exclusive(InUse* mark, const char* what) : mark_(mark) {
    mark_->Check(what);
    mark_->is_set_ = true;
    mark_->user_ = std::this_thread::get_id();
  }
  ~Exclusive() { mark_->is_set_ = false; }
  Exclusive(const Exclusive&) = delete;
  Exclusive& operator=(const Exclusive&) = delete;

 private:
  InUse* mark_;
};

}  // namespace poise
