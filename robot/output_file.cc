// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <system_error>

namespace poise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Throw(const fs::path& path, const std::string& why,
                        const std::error_code& reason) {
  throw std::invalid_argument(path.string() + ": " + why + ": " +
                              reason.message());
}

// Requires that files can be written in a folder that exists.
void RequireWritableFolder(const fs::path& folder, const fs::path& named) {
  if (access(folder.c_str(), W_OK | X_OK) != 0) ThrowNotWritten(named);
}

// Returns the file that a chain of links names, which may not exist. A link in
// /proc names an open file, which need not have a path: it is returned as it
// is.
fs::path FollowLinks(fs::path file) {
  constexpr int kMostLinks = 40;  // As Linux follows.
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(file, error); ++i) {
    // The folder may be a link as well, as /dev/fd is.
    const fs::path folder =
        fs::canonical(fs::absolute(file).parent_path(), error);
    if (folder.string().rfind("/proc/", 0) == 0) break;
    const fs::path named = fs::read_symlink(file, error);
    file = named.is_absolute() ? named : file.parent_path() / named;
  }
  return file;
}

// Writes a text and closes the file. Returns whether all of it was written; if
// not, the reason is in errno.
bool WriteAndClose(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(written);
    } else if (errno != EINTR) {
      const int reason = errno;
      close(descriptor);
      errno = reason;
      return false;
    }
  }
  return close(descriptor) == 0;
}

// Writes a text to a file itself; `flags` are those of open().
bool WriteDirectly(const fs::path& file, int flags, std::string_view text) {
  const int descriptor =
      open(file.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | flags, 0666);
  return descriptor >= 0 && WriteAndClose(descriptor, text);
}

// Creates a file beside another one, with a name that no file has. Returns its
// descriptor, which is negative if no file can be created.
int CreateBeside(const fs::path& file, fs::path* created) {
  for (int i = 0;; ++i) {
    *created = file;
    *created += "." + std::to_string(getpid()) + "-" + std::to_string(i);
    const int descriptor =
        open(created->c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
}

// Writes a text to a new file, and gives it the name of the old one, if any.
// Returns whether it succeeded. If not, the old file stays, there is no new
// one, and the reason is in errno.
bool Replace(const fs::path& file, const struct stat* old,
             std::string_view text) {
  fs::path draft;
  const int descriptor = CreateBeside(file, &draft);
  if (descriptor < 0) return false;
  // A change of the owner clears some permissions, which are set after it.
  const bool is_like_old =
      old == nullptr || (fchown(descriptor, old->st_uid, old->st_gid) == 0 &&
                         fchmod(descriptor, old->st_mode & 07777) == 0);
  if (!is_like_old) close(descriptor);
  const bool is_replaced = is_like_old && WriteAndClose(descriptor, text) &&
                           std::rename(draft.c_str(), file.c_str()) == 0;
  const int reason = errno;
  if (!is_replaced) unlink(draft.c_str());
  errno = reason;
  return is_replaced;
}

// Returns whether Replace() failed although the file itself may be writable:
// its folder or its owner cannot be changed, it is a mount point, or its name
// leaves no room for a longer one.
bool CannotBeReplaced(int reason) {
  return reason == EACCES || reason == EPERM || reason == EROFS ||
         reason == EBUSY || reason == ENAMETOOLONG;
}

}  // namespace

void WriteFile(const fs::path& file, std::string_view text) {
  const fs::path target = FollowLinks(file);
  struct stat old = {};
  const bool exists = stat(target.c_str(), &old) == 0;
  // A file that is not writable must not be replaced either.
  const bool is_plain = S_ISREG(old.st_mode) && old.st_nlink == 1 &&
                        access(target.c_str(), W_OK) == 0;
  const bool may_be_replaced = (!exists || is_plain) && !fs::is_symlink(target);
  if (may_be_replaced) {
    if (Replace(target, exists ? &old : nullptr, text)) return;
    if (!CannotBeReplaced(errno)) ThrowNotWritten(file);
  }
  if (!WriteDirectly(target, exists ? 0 : O_CREAT, text)) ThrowNotWritten(file);
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (error) Throw(folder, "cannot be made a folder", error);
  RequireWritableFolder(folder, folder);
}

void RequireWritable(const fs::path& file) {
  std::error_code error;
  if (fs::exists(file, error)) {
    if (fs::is_directory(file, error)) {
      Throw(file, "cannot be written",
            std::make_error_code(std::errc::is_a_directory));
    }
    if (access(file.c_str(), W_OK) != 0) ThrowNotWritten(file);
    return;
  }
  const fs::path target = FollowLinks(file);
  const fs::path folder =
      target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (fs::is_directory(folder, error)) RequireWritableFolder(folder, file);
}

void ThrowNotWritten(const fs::path& file) {
  Throw(file, "cannot be written",
        std::error_code(errno, std::generic_category()));
}

}  // namespace poise
