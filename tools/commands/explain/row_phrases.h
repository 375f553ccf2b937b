// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace poise {

/// Phrases, units, kinds and tasks of rows, as the run's summary has them. A row
/// that the summary does not describe has its name as its phrase.
class RowPhrases {
 public:
  RowPhrases() = default;

  /// @param summary  of a run; its key `rows` may be absent or malformed.
  explicit RowPhrases(const nlohmann::json& summary);

  std::string phrase(const std::string& name) const;
  std::string unit(const std::string& name) const;  ///< May be empty.
  std::string kind(const std::string& name) const;  ///< May be empty.

  /// The task of a row; without a description, its name up to the last dot.
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

/// A name as words: "left_foot" is "left foot".
std::string Spaced(std::string text);

}  // namespace poise
