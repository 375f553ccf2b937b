// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/convert_mesh.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <string>
#include <system_error>

#include "poise/robot/finding.h"
#include "poise/robot/mesh/child_process.h"
#include "poise/robot/mesh/read_stl.h"
#include "poise/robot/text_file.h"

namespace poise {
namespace {

constexpr size_t kMostMib = 1024;  // Memory of the child process.
constexpr size_t kMostOutputMib = 128;

// A file in memory that a child process inherits.
class SharedFile {
 public:
  SharedFile() : descriptor_(memfd_create("mesh", 0)) {}
  ~SharedFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  std::string path() const {
    return "/proc/self/fd/" + std::to_string(descriptor_);
  }

 private:
  int descriptor_;
};

// Undoes the rotation with which assimp turns the up axis of a COLLADA file to
// y. The axis is in the <asset> at the beginning of the file.
void UndoUpAxis(const std::filesystem::path& file, TriangleMesh* mesh) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(c & 0x7f));
  if (extension != ".dae") return;
  std::string start(size_t{1} << 16, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<size_t>(stream.gcount()));
  const std::string tag = "<up_axis>";
  const size_t at = start.find(tag);
  if (at == std::string::npos) return;
  const size_t value = start.find_first_not_of(" \t\r\n", at + tag.size());
  if (value == std::string::npos) return;
  const std::string axis = start.substr(value, 4);
  for (Eigen::Vector3f& p : mesh->vertices) {
    if (axis == "Z_UP") p = Eigen::Vector3f(p.x(), -p.z(), p.y());
    if (axis == "X_UP") p = Eigen::Vector3f(p.y(), -p.x(), p.z());
  }
}

// Returns how the child process failed, or "" if it did not.
std::string DescribeFailure(const ChildEnd& end, double seconds) {
  switch (end.kind) {
    case ChildEnd::Kind::kNotStarted:
      return end.code == ENOENT
                 ? "needs the command assimp, which is not installed: install "
                   "the package assimp-utils, or convert the mesh to STL"
                 : "needs the command assimp, which cannot be started (" +
                       std::generic_category().message(end.code) +
                       "): convert the mesh to STL";
    case ChildEnd::Kind::kTooSlow:
      return "takes assimp more than " + PrintNumber(seconds) + " s";
    case ChildEnd::Kind::kUnknown:
      return "cannot be converted: the exit code of assimp is lost, because "
             "this program ignores SIGCHLD";
    case ChildEnd::Kind::kSignal:
      if (end.code == SIGXFSZ) {
        return "becomes more than " + std::to_string(kMostOutputMib) +
               " MiB of triangles";
      }
      return "crashes assimp (signal " + std::to_string(end.code) +
             "), or needs more than 1 GiB";
    case ChildEnd::Kind::kExited:
      break;
  }
  if (end.code == 0) return "";
  return "cannot be read by assimp (exit code " + std::to_string(end.code) +
         ")";
}

}  // namespace

TriangleMesh ConvertMesh(const std::filesystem::path& file, double seconds) {
  const auto refuse = [&](const std::string& what) {
    throw Refusal(file.string(), 0, what);
  };
  const SharedFile out;
  if (!out.is_open()) refuse("cannot be converted: no file in memory");
  const ChildEnd end =
      RunChild({"assimp", "export", std::filesystem::absolute(file).string(),
                out.path(), "-fstlb"},
               {seconds, kMostMib << 20, kMostOutputMib << 20});
  if (const std::string failure = DescribeFailure(end, seconds);
      !failure.empty()) {
    refuse(failure);
  }
  TriangleMesh mesh;
  try {
    mesh = ReadStl(ReadTextFile(out.path(), kMostOutputMib), file.string());
  } catch (const Refusal& refusal) {
    refuse("cannot be converted by assimp: " + refusal.finding().what);
  }
  UndoUpAxis(file, &mesh);
  return mesh;
}

}  // namespace poise
