// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/row_phrases.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace poise {
namespace {

std::string Text(const nlohmann::json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : "";
}

bool Contains(const std::string& name, std::string_view part) {
  return name.find(part) != std::string::npos;
}

// Returns the unit of a row of momentum, which its name tells: l and k are the
// linear and the angular momentum.
std::string UnitByName(const std::string& name) {
  if (!Contains(name, "momentum.")) return "";
  return Contains(name, ".l") ? "N" : "N m";
}

// Returns the kind of a limit, which its name tells; empty for other rows.
std::string KindByName(const std::string& name) {
  constexpr std::pair<std::string_view, const char*> kKinds[] = {
      {"torque.", "torque_limit"},
      {"joint.", "joint_limit"},
      {".cop.", "cop_limit"},
      {"zmp", "cop_limit"},
      {".yaw", "yaw_limit"},
      {".friction.", "friction_limit"},
      {"unilateral.fz", "normal_force_limit"}};
  for (const auto& [part, kind] : kKinds) {
    if (Contains(name, part)) return kind;
  }
  return "";
}

}  // namespace

RowPhrases::RowPhrases(const nlohmann::json& summary) {
  if (!summary.is_object() || !summary.contains("rows")) return;
  const nlohmann::json& rows = summary["rows"];
  if (!rows.is_object()) return;
  for (const auto& [name, row] : rows.items()) {
    if (!row.is_object()) continue;
    rows_[name] = {Text(row, "phrase"), Text(row, "unit"), Text(row, "kind"),
                   Text(row, "task")};
  }
}

std::string RowPhrases::phrase(const std::string& name) const {
  const auto at = rows_.find(name);
  return at == rows_.end() || at->second.phrase.empty() ? name
                                                        : at->second.phrase;
}

std::string RowPhrases::unit(const std::string& name) const {
  const auto at = rows_.find(name);
  return at == rows_.end() ? UnitByName(name) : at->second.unit;
}

std::string RowPhrases::kind(const std::string& name) const {
  const auto at = rows_.find(name);
  return at == rows_.end() ? KindByName(name) : at->second.kind;
}

std::string RowPhrases::task(const std::string& name) const {
  const auto at = rows_.find(name);
  if (at != rows_.end() && !at->second.task.empty()) return at->second.task;
  return name.substr(0, name.rfind('.'));
}

bool RowPhrases::is_limit(const std::string& name) const {
  constexpr std::string_view kLimit = "limit";
  const std::string what = kind(name);
  return what.size() >= kLimit.size() &&
         what.substr(what.size() - kLimit.size()) == kLimit;
}

std::string Spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace poise
