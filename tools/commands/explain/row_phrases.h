// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace poise {

/// Phrases, units, kinds and tasks of rows, from the run's summary. If the
/// summary does not describe a row, its phrase is its name, which also tells
/// the unit of momentum and the kind of a limit.
class RowPhrases {
 public:
  RowPhrases() = default;

  /// @param summary  summary of a run. Its key `rows` may be absent or
  ///                 malformed.
  explicit RowPhrases(const nlohmann::json& summary);

  std::string phrase(const std::string& name) const;
  std::string unit(const std::string& name) const;  ///< May be empty.
  std::string kind(const std::string& name) const;  ///< May be empty.

  /// The task of a row. Without a description, the name up to the last dot.
  std::string task(const std::string& name) const;

  bool is_described(const std::string& name) const {
    return rows_.count(name) > 0;
  }
  bool is_limit(const std::string& name) const;

 private:
  struct Row {
    std::string phrase, unit, kind, task;
  };
  std::map<std::string, Row> rows_;
};

/// Replaces underscores by blanks: "left_foot" becomes "left foot".
std::string Spaced(std::string text);

}  // namespace poise
