// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/leg_names.h"

#include <algorithm>
#include <cctype>

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
  const std::string text = Lowered(name);
  const auto contains = [&](const char* word) {
    return text.find(word) != std::string::npos;
  };
  bool leg = false;
  for (const char* word :
       {"leg", "hip", "thigh", "femur", "knee", "shank", "shin", "calf",
        "calve", "tibia", "tarsus", "ankle", "foot", "feet", "sole", "toe"}) {
    leg |= contains(word);
  }
  bool arm = false;
  for (const char* word :
       {"arm", "clavicle", "shoulder", "bicep", "humerus", "elbow", "wrist",
        "hand", "palm", "finger", "thumb", "grip"}) {
    arm |= contains(word);
  }
  return (leg ? 1 : 0) - (arm ? 1 : 0);
}

}  // namespace poise
