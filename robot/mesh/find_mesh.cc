// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/find_mesh.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

namespace poise {
namespace {

using Path = std::filesystem::path;

bool Exists(const Path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

Path Absolute(const Path& path) {
  std::error_code error;
  return std::filesystem::absolute(path, error).lexically_normal();
}

// Removes a prefix from a text. Returns whether the text has the prefix.
bool TakePrefix(std::string_view prefix, std::string_view* text) {
  if (text->substr(0, prefix.size()) != prefix) return false;
  text->remove_prefix(prefix.size());
  return true;
}

// Returns the folders in an environment variable, separated by colons.
std::vector<Path> FoldersIn(const char* variable) {
  std::vector<Path> folders;
  const char* value = std::getenv(variable);
  std::string_view text = value == nullptr ? "" : value;
  while (!text.empty()) {
    const std::string_view folder = text.substr(0, text.find(':'));
    text.remove_prefix(std::min(text.size(), folder.size() + 1));
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

// Returns a file of the package `name`. The package is in a folder, or is the
// folder.
Path InFolder(const Path& folder, std::string_view name,
              std::string_view rest) {
  if (const Path inside = folder / name / rest; Exists(inside)) return inside;
  if (folder.filename() != name) return {};
  const Path itself = folder / rest;
  return Exists(itself) ? itself : Path{};
}

MeshPlace FindInPackage(const MeshPlaces& places, std::string_view name,
                        std::string_view rest) {
  const Path start = Absolute(places.urdf).parent_path();
  MeshPlace place{{}, start.string() + " and above"};
  for (Path folder = start;; folder = folder.parent_path()) {
    place.path = InFolder(folder, name, rest);
    if (!place.path.empty()) return place;
    if (!folder.has_relative_path()) break;  // The root.
  }
  std::vector<Path> folders = places.packages;
  for (const Path& folder : FoldersIn("ROS_PACKAGE_PATH")) {
    folders.push_back(folder);
  }
  for (const Path& prefix : FoldersIn("AMENT_PREFIX_PATH")) {
    folders.push_back(prefix / "share");
  }
  for (const Path& folder : folders) {
    place.searched += ", " + folder.string();
    place.path = InFolder(Absolute(folder), name, rest);
    if (!place.path.empty()) return place;
  }
  return place;
}

}  // namespace

MeshPlace FindMesh(const MeshPlaces& places, const std::string& file) {
  if (places.urdf.empty() || file.empty()) return {{}, "no folder"};
  std::string_view name = file;
  if (TakePrefix("package://", &name) || TakePrefix("model://", &name)) {
    const size_t slash = name.find('/');
    if (slash == std::string_view::npos) return {{}, "no folder"};
    return FindInPackage(places, name.substr(0, slash), name.substr(slash + 1));
  }
  TakePrefix("file://", &name);
  const Path folder = Absolute(places.urdf).parent_path();
  // If `name` is absolute, operator/ ignores the folder.
  const Path path = (folder / name).lexically_normal();
  return {Exists(path) ? path : Path{}, path.parent_path().string()};
}

}  // namespace poise
