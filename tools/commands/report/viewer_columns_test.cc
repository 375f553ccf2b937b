// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The scripts of the viewer contain names of columns of the log. These tests
// compare each name with the table of sim/log/columns.h.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "poise/sim/log/columns.h"
#include "poise/sim/log/log_reader.h"

namespace poise {
namespace {

// Replaces expressions such as ${joint} in `tau.${joint}`.
constexpr char kAnyName[] = "NAME";

std::string Contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Returns the strings of all scripts that begin like the name of a column, or
// that, as '.contact', end like one.
std::set<std::string> NamesInScripts() {
  const std::regex name(
      "['`]((?:base|com|com_ref|cop|plan|push|other|tau|q|lambda|residual|xi)"
      "\\.[^'`]*|\\.(?:contact|tilt|slide|phase|[fm][xyz])|"
      "\\$\\{foot\\w*\\}\\.[^'`]*)['`]");
  const std::regex expression("\\$\\{[^}]*\\}");
  std::set<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator("tools/viewer/src")) {
    if (entry.path().extension() != ".js") continue;
    const std::string text = Contents(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), name), end;
         match != end; ++match) {
      names.insert(std::regex_replace((*match)[1].str(), expression, kAnyName));
    }
  }
  return names;
}

// Returns true if the text is the start or the end of a column's name. A script
// may contain only a part of a name and add the axis later.
bool IsPartOfAColumn(const std::string& part) {
  const std::regex any(
      std::regex_replace(std::regex_replace(part, std::regex("\\."), "\\."),
                         std::regex(kAnyName), "\\w*"));
  for (const LogColumn& column :
       LogColumns({"FOOT"}, {"JOINT"}, {"momentum"}, 1)) {
    const std::string name(WithoutUnit(column.name));
    std::smatch match;
    if (!std::regex_search(name, match, any)) continue;
    if (part[0] == '.' ? match.suffix().length() == 0 : match.position() == 0) {
      return true;
    }
  }
  return false;
}

TEST(ViewerColumns, AllNamesAreColumnsOfTheLog) {
  const std::set<std::string> names = NamesInScripts();
  // The regular expression finds names of each kind.
  for (const char* known :
       {"base.qw", "com.", "cop.", ".contact", "tau.NAME"}) {
    EXPECT_EQ(names.count(known), 1u) << known;
  }
  for (const std::string& name : names) {
    EXPECT_TRUE(IsPartOfAColumn(name)) << name;
  }
}

TEST(ViewerColumns, CheckDetectsWrongNames) {
  EXPECT_TRUE(IsPartOfAColumn("base.z"));
  for (const char* name : {"com.w", "copp.", "tau_NAME", ".touch"}) {
    EXPECT_FALSE(IsPartOfAColumn(name)) << name;
  }
}

}  // namespace
}  // namespace poise
