// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/parse_json.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/text_file.h"

namespace poise {
namespace {

using nlohmann::json;

// Throws an error about the character `at` of the text.
[[noreturn]] void RefuseAt(std::string_view text, size_t at,
                           const std::string& source, const std::string& what) {
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t line_end = before.rfind('\n');  // npos + 1 is 0.
  throw Refusal(source + ":" + std::to_string(line) + ":" +
                    std::to_string(before.size() - line_end),
                0, what);
}

// Returns the first place of a part outside quotation marks, or the end.
size_t FindOutsideTexts(std::string_view text, std::string_view part) {
  bool is_quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') is_quoted = !is_quoted;
    if (is_quoted && text[i] == '\\') ++i;  // The next character is escaped.
    if (!is_quoted && text.substr(i, part.size()) == part) return i;
  }
  return text.size();
}

// Returns an error of the parser in words.
//
// @param rest  the text from the error on.
std::string Explain(const json::parse_error& error, std::string_view rest) {
  const std::string said = error.what();
  const auto has = [&](const char* part) {
    return said.find(part) != std::string::npos;
  };
  // A literal is cut short: "tr".
  const bool is_cut =
      has("invalid literal") &&
      rest.find_first_not_of(" \t\r\n") == std::string_view::npos;
  if (is_cut || has("unexpected end of input")) {
    return "the file ends too early";
  }
  if (has("invalid string")) {
    return "a text has no closing quotation mark, or a character that JSON "
           "forbids";
  }
  if (has("invalid number")) return "a number is malformed";
  const size_t token = said.find("unexpected ");
  if (token == std::string::npos) {
    return "there is text that is neither quoted, nor a number, true, false or "
           "null";
  }
  std::string words = said.substr(token);
  const std::string expected = "; expected ";
  const size_t at = words.find(expected);
  if (at != std::string::npos) words.replace(at, expected.size(), ", must be ");
  return words;
}

}  // namespace

json ParseJson(std::string_view text, const std::string& source) {
  constexpr int kDeepest = 100;
  using Event = json::parse_event_t;
  std::vector<std::set<std::string>> keys;  // Keys of each open object.
  const auto keep = [&](int depth, Event event, json& parsed) {
    if (depth > kDeepest) {
      throw Refusal(source, 0, "is nested more than 100 levels deep");
    }
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key && !keys.back().insert(parsed).second) {
      throw Refusal(source, 0, "has the key " + parsed.dump() + " twice");
    }
    return true;
  };
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw Refusal(source, 0, "is empty, must be JSON");
  }
  // The parser would take a NUL for the end of the text.
  const size_t nul = text.find('\0');
  if (nul != std::string_view::npos) {
    RefuseAt(text, nul, source, "is not JSON: has a NUL character");
  }
  try {
    return json::parse(text.begin(), text.end(), keep);
  } catch (const json::parse_error& error) {
    const size_t at =
        std::min(std::max<size_t>(error.byte, 1) - 1, text.size());
    RefuseAt(text, std::min(at, text.size() - 1), source,
             "is not JSON: " + Explain(error, text.substr(at)));
  } catch (const json::out_of_range& error) {
    // "number overflow parsing '1e400'".
    const std::string said = error.what();
    const size_t quote = said.find('\'');
    const std::string number =
        said.substr(quote + 1, said.rfind('\'') - quote - 1);
    RefuseAt(text, FindOutsideTexts(text, number), source,
             "number is " + Quoted(number) + ", which is too large");
  }
}

json ReadJsonOfRun(const std::filesystem::path& file,
                   const std::string& remedy) {
  constexpr size_t kMostMib = 100;
  try {
    json value = ParseJson(ReadTextFile(file, kMostMib), file.string());
    if (value.is_object()) return value;
    throw Refusal(file.string(), 0,
                  "is " + ShowJson(value) + ", must be a JSON object");
  } catch (const Refusal& refusal) {
    throw std::invalid_argument(refusal.what() + ("; " + remedy));
  }
}

std::string Entries(size_t n) {
  return std::to_string(n) + (n == 1 ? " entry" : " entries");
}

std::string ShowJson(const json& value) {
  constexpr size_t kMost = 40;
  const std::string text =
      value.dump(-1, ' ', true, json::error_handler_t::replace);
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

}  // namespace poise
