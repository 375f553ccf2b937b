// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/finding.h"

namespace poise {

std::string Quoted(std::string_view name) {
  constexpr size_t kLongest = 60;
  std::string text;
  for (const char c : name.substr(0, kLongest)) {
    const bool control = (c >= 0 && c < ' ') || c == 0x7f;
    text += control ? ' ' : c;
  }
  if (name.size() > kLongest) {
    // Not in the middle of a UTF-8 character, whose later bytes are 10xxxxxx.
    size_t end = kLongest;
    while (end > 0 && (name[end] & 0xc0) == 0x80) --end;
    text.resize(end);
    text += "...";
  }
  return "'" + text + "'";
}

std::string Message(const std::string& file, const Finding& finding) {
  std::string message = file;
  if (finding.line > 0) message += ":" + std::to_string(finding.line);
  if (!finding.where.empty()) message += ": " + finding.where;
  message += ": " + finding.what;
  if (!finding.why.empty()) message += ", " + finding.why;
  return message;
}

}  // namespace poise
