// Replaces files: written beside, brought to disk, renamed.
#include "equipoise/io/replacement.hpp"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "equipoise/base/error.hpp"
#include "equipoise/words/files.hpp"

namespace equipoise::io {

namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::string own_ending() { return fmt::format(".new-{}", getpid()); }

// Such as /dev/stdout, which must be written to, not replaced.
bool names_open_file(const std::string& path) {
  return path.starts_with("/dev/std") || path.starts_with("/dev/fd/") || path.starts_with("/proc/");
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw RunError(fmt::format("{}: cannot be written: {}", path, error_text(error)));
}

bool write_all(int file, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(file, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

std::string error_text(int error) { return std::generic_category().message(error); }

std::string resolved(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (names_open_file(path) || (fs::exists(status) && !fs::is_regular_file(status))) return path;
  const fs::path whole = fs::weakly_canonical(path, error);
  return error || whole.empty() ? path : whole.string();
}

std::string why_not_writable(const std::string& path) {
  const std::string target = resolved(path), folder = folder_of(target);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) return words::files::is_a_folder;
  if (fs::exists(status) && access(target.c_str(), W_OK) != 0) return error_text(errno);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  if (!fs::exists(folder, error)) return fmt::format(words::files::no_such_folder, folder_of(path));
  if (!fs::is_directory(folder, error)) return fmt::format(words::files::is_no_folder, folder_of(path));
  const std::string trial = target + own_ending();
  const int file = open(trial.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return error_text(errno);
  close(file);
  unlink(trial.c_str());
  return {};
}

bool to_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = fsync(file) == 0;
  const int error = errno;
  close(file);
  errno = error;
  return done;
}

Replacement::Replacement(const std::string& path, const std::string& ending) : path_(resolved(path)) {
  struct stat old {};
  const bool there = stat(path_.c_str(), &old) == 0;
  beside_ = (!there || S_ISREG(old.st_mode)) && !names_open_file(path_);
  file_ = !beside_ ? path_ : path_ + (ending.empty() ? own_ending() : ending);
  if (!beside_) return;
  unlink(file_.c_str());  // left by a process that was killed
  const int file = open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) fail(path_, errno);
  if (there) (void)!fchmod(file, old.st_mode & 07777);  // permissions of the old file, where possible
  close(file);
}

Replacement::~Replacement() {
  if (beside_ && !done_) unlink(file_.c_str());
}

void Replacement::commit() {
  if (!beside_) return;
  if (!to_disk(file_) || std::rename(file_.c_str(), path_.c_str()) != 0) fail(path_, errno);
  done_ = true;
  (void)to_disk(folder_of(path_));  // the name; file systems that cannot do this bring it to disk by themselves
}

void write_whole(const std::string& path, const std::string& text) {
  Replacement place(path);
  const int file = open(place.file().c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail(path, errno);
  const bool written = write_all(file, text);
  const int error = errno;
  if (close(file) != 0 && written) fail(path, errno);
  if (!written) fail(path, error);
  place.commit();
}

}  // namespace equipoise::io
