// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/finding.h"

#include <algorithm>
#include <locale>
#include <sstream>

namespace poise {
namespace {

constexpr char32_t kInvalid = 0xffffffff;

// Removes the first character from a text that is not empty, and returns its
// code point. If the text is not UTF-8 there, removes one byte and returns
// kInvalid.
char32_t TakeCharacter(std::string_view* text) {
  const auto byte = [&](size_t i) -> unsigned char { return (*text)[i]; };
  const auto take = [&](size_t bytes, char32_t character) {
    text->remove_prefix(bytes);
    return character;
  };
  const unsigned char first = byte(0);
  if (first < 0x80) return take(1, first);
  const size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text->size() < size) {
    return take(1, kInvalid);
  }
  char32_t character = first & (0x7f >> size);
  for (size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return take(1, kInvalid);
    character = character << 6 | (byte(i) & 0x3f);
  }
  // UTF-8 forbids an encoding that is longer than needed, half of a surrogate
  // pair, and a code point above U+10FFFF.
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_half = character >= 0xd800 && character < 0xe000;
  if (character < kLeast[size] || is_half || character > 0x10ffff) {
    return take(1, kInvalid);
  }
  return take(size, character);
}

// Returns whether a character is a control character, ends a line, or changes
// the writing direction.
bool IsUnprintable(char32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x61c ||
         (c >= 0x200b && c <= 0x200f) || (c >= 0x2028 && c <= 0x202e) ||
         (c >= 0x2060 && c <= 0x206f) || c == 0xfeff;
}

}  // namespace

bool IsUtf8(std::string_view text) {
  while (!text.empty()) {
    if (TakeCharacter(&text) == kInvalid) return false;
  }
  return true;
}

std::string OneLine(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const std::string_view before = text;
    const char32_t character = TakeCharacter(&text);
    if (character == kInvalid) {
      line += '?';
    } else if (IsUnprintable(character)) {
      line += ' ';
    } else {
      line += before.substr(0, before.size() - text.size());
    }
  }
  return line;
}

std::string PrintNumber(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

std::string Quoted(std::string_view name) {
  constexpr size_t kLongest = 60;
  size_t end = std::min(name.size(), kLongest);
  // The cut must not split a character. Continuation bytes are 10xxxxxx.
  while (end > 0 && end < name.size() && (name[end] & 0xc0) == 0x80) --end;
  const char* rest = end < name.size() ? "...'" : "'";
  return "'" + OneLine(name.substr(0, end)) + rest;
}

std::string Message(const std::string& file, const Finding& finding) {
  std::string message = file;
  if (finding.line > 0) message += ":" + std::to_string(finding.line);
  if (!finding.where.empty()) message += ": " + finding.where;
  message += ": " + finding.what;
  if (!finding.why.empty()) message += ", " + finding.why;
  return OneLine(message);
}

}  // namespace poise
