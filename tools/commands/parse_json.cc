// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/parse_json.h"

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace poise {

nlohmann::json ParseJson(std::string_view text) {
  constexpr int kDeepest = 100;
  using Event = nlohmann::json::parse_event_t;
  std::vector<std::set<std::string>> keys;  // Keys of each open object.
  const auto keep = [&keys](int depth, Event event, nlohmann::json& parsed) {
    if (depth > kDeepest) {
      throw std::invalid_argument("is nested more than 100 levels deep");
    }
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key && !keys.back().insert(parsed).second) {
      throw std::invalid_argument("has the key " + parsed.dump() + " twice");
    }
    return true;
  };
  // The parser would take it for the end.
  if (text.find('\0') != std::string_view::npos) {
    throw std::invalid_argument("not JSON: has a NUL character");
  }
  try {
    return nlohmann::json::parse(text.begin(), text.end(), keep);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("not JSON: ") + error.what());
  }
}

}  // namespace poise
