// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace poise {

/// The severity of a finding. kNote: unusual, but the file is read as written.
/// kWarn: the file can be used, but control may fail or the result be wrong.
/// kReject: the file cannot be used as a robot.
enum class Severity { kNote, kWarn, kReject };

/// A finding in a robot file. Each part is one line of text.
struct Finding {
  Severity severity;
  std::string where;  ///< The element: "joint 'l_knee' <limit>".
  std::string what;   ///< The observation: "upper is 'abc'".
  std::string why;    ///< The rule or the consequence: "must be a number".
  int line = 0;       ///< Line in the file, or 0 if unknown.
};

/// Returns whether a text is valid UTF-8 to its last byte.
bool IsUtf8(std::string_view text);

/// Returns an untrusted text, made safe for a message of one line. Line breaks,
/// control characters and characters that change the writing direction become
/// spaces. A byte that is not valid UTF-8 becomes a question mark.
std::string OneLine(std::string_view text);

/// Returns a number as text with at most six significant digits. The text does
/// not depend on the locale.
std::string PrintNumber(double value);

/// Returns a name from a file for a message: in quotes, on one line, and cut
/// after 60 bytes.
std::string Quoted(std::string_view name);

/// Returns "FILE:LINE: where: what, why", on one line.
std::string Message(const std::string& file, const Finding& finding);

/// Thrown if a file cannot be used. what() returns Message() of the file and of
/// the finding that is the reason.
class Refusal : public std::invalid_argument {
 public:
  Refusal(const std::string& file, Finding finding)
      : std::invalid_argument(Message(file, finding)),
        finding_(std::move(finding)) {}
  Refusal(const std::string& file, int line, std::string what)
      : Refusal(file, {Severity::kReject, "", std::move(what), "", line}) {}

  const Finding& finding() const { return finding_; }

 private:
  Finding finding_;
};

}  // namespace poise
