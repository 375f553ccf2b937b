// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace poise {

/// kNote: odd, but means what it says. kWarn: it can be used, but control may
/// fail or lie. kReject: it cannot be read as a robot.
enum class Severity { kNote, kWarn, kReject };

/// What was found in a robot file, each part on one line.
struct Finding {
  Severity severity;
  std::string where;  ///< "joint 'l_knee' <limit>".
  std::string what;   ///< "upper is 'abc'".
  std::string why;    ///< "must be a number".
  int line = 0;       ///< In the file; 0 where it has none.
};

/// Whether a text is UTF-8 to its last byte.
bool IsUtf8(std::string_view text);

/// A text from anywhere, for a message of one line: what would break the line,
/// steer a terminal or turn the direction of writing becomes a blank, what is
/// not UTF-8 a question mark.
std::string OneLine(std::string_view text);

/// The shortest text of six digits, in whatever locale.
std::string PrintNumber(double value);

/// A name from a file, for a message: in quotes, on one line, and cut where it
/// is very long.
std::string Quoted(std::string_view name);

/// "FILE:LINE: where: what, why", on one line.
std::string Message(const std::string& file, const Finding& finding);

/// A file that cannot be used, and what in it is to blame; what() is Message()
/// of the two.
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
