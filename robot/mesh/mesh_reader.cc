// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/mesh_reader.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "poise/robot/finding.h"
#include "poise/robot/mesh/convert_mesh.h"
#include "poise/robot/mesh/find_mesh.h"
#include "poise/robot/mesh/read_obj.h"
#include "poise/robot/mesh/read_stl.h"
#include "poise/robot/text_file.h"

namespace poise {
namespace {

// A program may read the meshes twice, and the doctor takes less than 10 s.
constexpr double kMostSeconds = 4;
constexpr size_t kMostMib = 128;  // A file.
constexpr size_t kMostMibInAll = 512;
// Largest distance of a vertex from the origin, m. Links are smaller, but a
// mesh in mm whose scale is missing is larger.
constexpr double kFarthest = 10;

std::string Extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
}

void Scale(const std::string& file, const Eigen::Vector3d& scale,
           TriangleMesh* mesh) {
  double farthest = 0;
  for (Eigen::Vector3f& p : mesh->vertices) {
    const Eigen::Vector3d scaled = p.cast<double>().cwiseProduct(scale);
    if (!scaled.allFinite()) {
      throw Refusal(file, 0, "has a scale that is too large or not finite");
    }
    farthest = std::max(farthest, scaled.norm());
    p = scaled.cast<float>();
  }
  if (farthest <= kFarthest) return;
  throw Refusal(file, 0,
                "has a vertex " + PrintNumber(farthest) +
                    " m from its origin, must be within " +
                    PrintNumber(kFarthest) +
                    " m: correct the scale in the robot file");
}

// Throws if the file is what Git leaves in place of a large file.
void CheckPointer(const std::filesystem::path& path) {
  constexpr std::string_view kPointer = "version https://git-lfs.github.com/";
  std::string start(kPointer.size(), '\0');
  std::ifstream(path, std::ios::binary)
      .read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != kPointer) return;
  throw Refusal(path.string(), 0,
                "is a Git LFS pointer, fetch it with git lfs pull");
}

// Reads a file that exists, without its scale.
TriangleMesh ReadFile(const std::filesystem::path& path, double seconds) {
  CheckPointer(path);
  const std::string extension = Extension(path);
  if (extension == ".stl") {
    return ReadStl(ReadTextFile(path, kMostMib), path.string());
  }
  if (extension == ".obj") {
    return ReadObj(ReadTextFile(path, kMostMib), path.string());
  }
  return ConvertMesh(path, seconds);
}

}  // namespace

double MeshReader::SecondsLeft() const {
  return kMostSeconds - std::chrono::duration<double>(used_).count();
}

TriangleMesh MeshReader::Read(const Mesh& mesh) {
  const MeshPlace place = FindMesh(places_, mesh.file);
  if (place.path.empty()) {
    throw Refusal(
        mesh.file, 0,
        "is missing or no regular file, was searched in " + place.searched);
  }
  const std::string file = place.path.string();
  std::error_code error;
  const auto size = std::filesystem::file_size(place.path, error);
  if (!error && size > kMostMib << 20) {
    throw Refusal(
        file, 0,
        "is not read: has more than " + std::to_string(kMostMib) + " MiB");
  }
  if (!error) bytes_ += size;
  if (bytes_ > kMostMibInAll << 20) {
    throw Refusal(file, 0,
                  "is not read: the robot's meshes have more than " +
                      std::to_string(kMostMibInAll) + " MiB");
  }
  if (SecondsLeft() <= 0) {
    throw Refusal(file, 0,
                  "is not read: the robot's meshes take more than " +
                      PrintNumber(kMostSeconds) + " s");
  }
  const Clock::time_point start = Clock::now();
  struct Stop {
    ~Stop() { *used += Clock::now() - start; }
    Clock::time_point start;
    Clock::duration* used;
  } const stop{start, &used_};
  TriangleMesh triangles = ReadFile(place.path, SecondsLeft());
  Scale(file, mesh.scale, &triangles);
  return triangles;
}

bool MeshReader::Finds(const Mesh& mesh) const {
  return !FindMesh(places_, mesh.file).path.empty();
}

}  // namespace poise
