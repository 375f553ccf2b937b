// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace poise {

/// The error that an input cannot be used. It carries the path of the field that
/// is wrong, so that a program can name the file or the option that set it.
class InputError : public std::invalid_argument {
 public:
  /// Makes an error whose message does not name the field by its path.
  ///
  /// @param field    "pushes[2].link", or "robot".
  /// @param message  is what().
  InputError(std::string field, const std::string& message)
      : std::invalid_argument(message), field_(std::move(field)) {}

  /// Makes an error whose message begins with the path: what() is `field`, text,
  /// `other`, rest, without anything between them.
  ///
  /// @param other  a second field that the value does not go with, or empty.
  static InputError OfValue(const std::string& field, const std::string& text,
                            const std::string& other = "",
                            const std::string& rest = "");

  const std::string& field() const { return field_; }
  const std::string& other() const { return other_; }

  /// Returns what() with each field by the name that a function gives it.
  std::string Say(
      const std::function<std::string(const std::string& field)>& name) const;

 private:
  std::string field_;
  std::string other_;
  std::string text_;  // Empty if what() does not begin with the field.
  std::string rest_;
};

}  // namespace poise
