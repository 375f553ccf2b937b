// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

#include "poise/robot/finding.h"

namespace poise {

/// Thrown if an input cannot be used. The error carries the path of the invalid
/// field, so that a program can name the file or the option that set the field.
class InputError : public std::invalid_argument {
 public:
  /// Makes an error whose message does not contain the path of the field.
  ///
  /// @param field    the path of the field: "pushes[2].link", or "robot".
  /// @param message  the text that what() returns.
  InputError(std::string field, const std::string& message)
      : std::invalid_argument(message), field_(std::move(field)) {}

  /// Makes an error whose message begins with the path of the field. what()
  /// returns `field`, `text`, `other` and `rest`, joined without separators.
  ///
  /// @param other  the path of a second field that contradicts the value, or
  ///               empty.
  static InputError OfValue(const std::string& field, const std::string& text,
                            const std::string& other = "",
                            const std::string& rest = "");

  const std::string& field() const { return field_; }
  const std::string& other() const { return other_; }

  /// Returns what(), with the path of each field replaced by name(path).
  std::string Say(
      const std::function<std::string(const std::string& field)>& name) const;

 private:
  std::string field_;
  std::string other_;
  std::string text_;  // Empty if what() does not begin with the field.
  std::string rest_;
};

/// Returns the path of an entry of a list: "pushes[2]".
std::string EntryPath(const std::string& list, std::size_t entry);

/// Returns make(). If it throws a std::invalid_argument that names neither a
/// field nor a file, throws it as an InputError of `field`.
template <typename Make>
auto MakeOfField(const std::string& field, Make make) -> decltype(make()) {
  try {
    return make();
  } catch (const InputError&) {
    throw;
  } catch (const Refusal&) {  // Already names its file.
    throw;
  } catch (const std::invalid_argument& error) {
    throw InputError(field, error.what());
  }
}

}  // namespace poise
