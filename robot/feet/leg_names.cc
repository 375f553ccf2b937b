// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/leg_names.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <vector>

namespace poise {
namespace {

bool IsLetter(char c) { return c >= 'a' && c <= 'z'; }

std::string Lowered(std::string text) {
  for (char& c : text) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

// Replaces each `left` by `right`.
std::string Mirrored(const std::string& text) {
  const std::string left = "left";
  std::string mirrored;
  for (size_t i = 0; i < text.size();) {
    const bool is_left = text.compare(i, left.size(), left) == 0;
    mirrored += is_left ? "right" : text.substr(i, 1);
    i += is_left ? left.size() : 1;
  }
  return mirrored;
}

// Returns whether two names differ in at least one place, and everywhere by an
// `l` in the first one and an `r` in the second one.
bool DifferByLetter(const std::string& a, const std::string& b) {
  if (a.size() != b.size() || a == b) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i] && !(a[i] == 'l' && b[i] == 'r')) return false;
  }
  return true;
}

// Returns whether a letter stands alone: its neighbors are not letters.
bool HasLoneLetter(const std::string& name, char letter) {
  for (size_t i = 0; i < name.size(); ++i) {
    if (name[i] != letter || (i > 0 && IsLetter(name[i - 1]))) continue;
    if (i + 1 == name.size() || !IsLetter(name[i + 1])) return true;
  }
  return false;
}

// Returns 1 if the words of a name say left, -1 if they say right, else 0.
int SideByWords(const std::string& name) {
  const bool left = name.find("left") != std::string::npos;
  const bool right = name.find("right") != std::string::npos;
  if (left != right) return left ? 1 : -1;
  const bool l = HasLoneLetter(name, 'l');
  return l == HasLoneLetter(name, 'r') ? 0 : (l ? 1 : -1);
}

constexpr std::string_view kLegs[] = {
    "leg",   "hip",   "thigh",  "femur", "knee", "shank", "shin", "calf",
    "calve", "tibia", "tarsus", "ankle", "foot", "feet",  "sole", "toe"};
constexpr std::string_view kArms[] = {
    "arm",  "clavicle", "shoulder", "bicep", "humerus", "elbow",  "wrist",
    "hand", "palm",     "finger",   "thumb", "grip",    "gripper"};
// Parts of a word before and after the name of a part of a limb, as in
// `lupperleg` and `kneepitch`. Any single letter may come before.
constexpr std::string_view kBefore[] = {"",      "left",  "right", "up",
                                        "upper", "lower", "fore"};
constexpr std::string_view kAfter[] = {
    "",     "s",     "l",    "r",   "left", "right", "pitch", "roll", "yaw",
    "link", "joint", "base", "pad", "tip",  "end",   "plate", "motor"};

// Splits a name at characters that are no letters, and before a capital that
// follows or precedes a small letter: `LHipYaw` has the words l, hip and yaw.
std::vector<std::string> Words(const std::string& name) {
  const auto is_upper = [&](size_t i) {
    return i < name.size() && name[i] >= 'A' && name[i] <= 'Z';
  };
  const auto is_lower = [&](size_t i) {
    return i < name.size() && IsLetter(name[i]);
  };
  std::vector<std::string> words(1);
  for (size_t i = 0; i < name.size(); ++i) {
    if (!is_upper(i) && !is_lower(i)) {
      words.emplace_back();
      continue;
    }
    if (is_upper(i) && i > 0 && (is_lower(i - 1) || is_lower(i + 1))) {
      words.emplace_back();
    }
    words.back() += name[i];
  }
  for (std::string& word : words) word = Lowered(word);
  return words;
}

// Returns whether a word is the name of a part, perhaps with another part of a
// word before and after it.
template <std::size_t n>
bool IsOneOf(std::string_view word, const std::string_view (&parts)[n]) {
  const auto ends_well = [](std::string_view rest) {
    return std::find(std::begin(kAfter), std::end(kAfter), rest) !=
           std::end(kAfter);
  };
  for (const std::string_view before : kBefore) {
    for (const std::size_t letter : {0, 1}) {
      if (word.substr(std::min(letter, word.size()), before.size()) != before) {
        continue;
      }
      const std::size_t at = letter + before.size();
      for (const std::string_view part : parts) {
        if (at < word.size() && word.substr(at, part.size()) == part &&
            ends_well(word.substr(at + part.size()))) {
          return true;
        }
      }
    }
  }
  return false;
}

bool IsLeftOf(const std::string& a, const std::string& b) {
  if (a == b) return false;
  return DifferByLetter(a, b) || Mirrored(a) == b;
}

}  // namespace

int CompareSides(const std::string& a, const std::string& b) {
  const std::string first = Lowered(a);
  const std::string second = Lowered(b);
  if (IsLeftOf(first, second)) return 1;
  if (IsLeftOf(second, first)) return -1;
  const int side = SideByWords(first);
  return side == -SideByWords(second) ? side : 0;
}

int LegOrArm(const std::string& name) {
  bool leg = false, arm = false;
  for (const std::string& word : Words(name)) {
    leg |= IsOneOf(word, kLegs);
    arm |= IsOneOf(word, kArms);
  }
  return (leg ? 1 : 0) - (arm ? 1 : 0);
}

}  // namespace poise
