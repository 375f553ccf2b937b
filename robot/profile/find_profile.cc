// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/find_profile.h"

#include <system_error>

namespace poise {
namespace {

// Converts ASCII letters to lower case and keeps all others, in every locale.
std::string Lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

// Returns whether a name is `start`, or is `start` followed by _ or -.
bool BeginsWithWord(const std::string& name, const std::string& start) {
  if (start.empty() || name.rfind(start, 0) != 0) return false;
  return name.size() == start.size() || name[start.size()] == '_' ||
         name[start.size()] == '-';
}

}  // namespace

std::filesystem::path FindProfile(const std::string& name,
                                  const std::filesystem::path& urdf,
                                  const std::filesystem::path& folder) {
  std::error_code missing;
  const std::filesystem::path beside =
      std::filesystem::path(urdf).replace_extension(".yaml");
  if (std::filesystem::is_regular_file(beside, missing)) return beside;
  std::filesystem::path found;
  std::size_t longest = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(folder, missing)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string stem = Lower(entry.path().stem().string());
    if (stem.size() <= longest) continue;
    if (BeginsWithWord(Lower(name), stem) ||
        BeginsWithWord(Lower(urdf.stem().string()), stem)) {
      found = entry.path();
      longest = stem.size();
    }
  }
  return found;
}

}  // namespace poise
