// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace poise {

/// Splits the text of a mesh file into words, line by line. Words are separated
/// by spaces and tabs, lines by any line break.
class MeshWords {
 public:
  /// @param text    must live as long as this object.
  /// @param source  the name of the file in messages.
  MeshWords(std::string_view text, std::string source)
      : text_(text), source_(std::move(source)) {}

  /// Returns the next word of the file, or nothing at its end.
  std::optional<std::string_view> Next();

  /// Returns the next word of the current line, or nothing at its end.
  std::optional<std::string_view> NextOfLine();

  /// Reads the next word of the current line as a finite number. Throws Refusal
  /// otherwise.
  float NextNumber();

  /// Leaves out the other words of the current line.
  void SkipLine();

  /// Throws Refusal with the current line.
  [[noreturn]] void Refuse(const std::string& what) const;

 private:
  std::string_view text_;
  std::string source_;
  size_t at_ = 0;
  int line_ = 1;
};

}  // namespace poise
