// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/row_phrases.h"

#include <algorithm>
#include <string_view>

namespace poise {
namespace {

std::string Text(const nlohmann::json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : "";
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
  return at == rows_.end() ? "" : at->second.unit;
}

std::string RowPhrases::kind(const std::string& name) const {
  const auto at = rows_.find(name);
  return at == rows_.end() ? "" : at->second.kind;
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
