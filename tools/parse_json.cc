// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/parse_json.h"

#include <stdexcept>
#include <string>

namespace poise {

nlohmann::json ParseJson(std::string_view text) {
  constexpr int kDeepest = 100;
  const auto keep = [](int depth, nlohmann::json::parse_event_t /*event*/,
                       nlohmann::json& /*parsed*/) {
    if (depth > kDeepest) {
      throw std::invalid_argument("is nested over 100 deep");
    }
    return true;
  };
  try {
    return nlohmann::json::parse(text.begin(), text.end(), keep);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("not JSON: ") + error.what());
  }
}

}  // namespace poise
