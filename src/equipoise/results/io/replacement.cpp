// Replaces files: written next to the old one, flushed to disk, renamed. The seal is a mark, the length and the
// checksum of everything before it, which other readers ignore.
#include "equipoise/results/io/replacement.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/interrupted.hpp"
#include "equipoise/results/io/checksum.hpp"
#include "equipoise/results/io/disk_file.hpp"

namespace equipoise::io {

namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// Creates a file next to `path` under a new name: existing files belong to others.
std::string create_beside(const std::string& path, DiskFile& file, int& error) {
  constexpr int most = 1000;
  std::string name;
  for (int k = 1; k <= most; ++k) {
    name = fmt::format("{}.new-{}-{}", path, process_number(), k);
    error = file.open(name, DiskFile::Open::create);
    if (error != EEXIST) break;
  }
  return name;
}

// Such as /dev/stdout, which must be written to, not replaced.
bool names_open_file(const std::string& path) {
  return path.starts_with("/dev/std") || path.starts_with("/dev/fd/") || path.starts_with("/proc/");
}

[[noreturn]] void fail(const std::string& path, int error) {
  if (error == EINTR) throw Interrupted(path);
  throw RunError(fmt::format("{}: cannot be written: {}", path, error_text(error)));
}

}  // namespace

std::string error_text(int error) { return std::generic_category().message(error); }

// Also of links to files that are not there yet, which the library's canonical paths do not follow.
std::string resolved(const std::string& path) {
  constexpr int most_links = 40;  // as Linux follows
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (names_open_file(path) || (fs::exists(status) && !fs::is_regular_file(status))) return path;
  fs::path end = path;
  for (int k = 0; k < most_links && fs::is_symlink(fs::symlink_status(end, error)); ++k)
    end = end.parent_path() / fs::read_symlink(end, error);
  const fs::path whole = fs::weakly_canonical(end, error);
  return error || whole.empty() ? path : whole.string();
}

std::string why_not_writable(const std::string& path) {
  const std::string target = resolved(path), folder = folder_of(target);
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(target, error))) return error_text(ELOOP);
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) return "is a folder";
  if (const int refused = fs::exists(status) ? may_write(target) : 0) return error_text(refused);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  if (!fs::exists(folder, error))
    return fmt::format("the folder {} does not exist", fs::is_symlink(path, error) ? folder : folder_of(path));
  if (!fs::is_directory(folder, error)) return fmt::format("{} is not a folder", folder_of(path));
  DiskFile file;
  int refused = 0;
  const std::string trial = create_beside(target, file, refused);
  if (refused) return error_text(refused);
  (void)remove_file(trial);
  return {};
}

std::string why_no_results_at(const std::string& path) {
  const std::string problem = why_not_writable(path);
  return problem.empty() && existing(path).special() ? "only a regular file can hold results" : problem;
}

int to_disk(const std::string& path) {
  DiskFile file;
  if (const int error = file.open(path, DiskFile::Open::read)) return error;
  return file.to_disk(true);
}

Replacement::Replacement(const std::string& path) : path_(resolved(path)) {
  const Existing old = existing(path_);
  beside_ = !old.special() && !names_open_file(path_);
  if (!beside_) {
    file_ = path_;
    return;
  }
  DiskFile file;
  int error = 0;
  file_ = create_beside(path_, file, error);
  if (error) {
    beside_ = false;  // nothing to remove
    fail(path_, error);
  }
  if (old.there) (void)file.set_permissions(old.permissions);  // those of the old file, where possible
}

Replacement::~Replacement() {
  if (beside_ && !done_) (void)remove_file(file_);
}

void Replacement::commit() {
  if (!beside_) return;
  if (const int error = to_disk(file_)) fail(path_, error);
  if (std::rename(file_.c_str(), path_.c_str()) != 0) fail(path_, errno);
  done_ = true;
  (void)to_disk(folder_of(path_));  // the name; file systems that cannot do this bring it to disk by themselves
}

void write_whole(const std::string& path, const std::string& text) {
  Replacement place(path);
  DiskFile file;
  if (const int error = file.open(place.file(), DiskFile::Open::write)) fail(path, error);
  if (const int error = file.write(text)) fail(path, error);
  if (const int error = file.close()) fail(path, error);
  place.commit();
}

namespace {

constexpr std::uint64_t seal_mark = 0x314C414553505145;

struct Seal {
  std::uint64_t mark = seal_mark, length = 0, checksum = 0;
};

}  // namespace

void seal(const std::string& path, const std::string& name) {
  DiskFile file;
  int error = file.open(path, DiskFile::Open::update);
  Seal s;
  s.length = file.size().value_or(0);
  Checksum sum;
  const bool read = file.add_to(sum, 0, s.length);
  s.checksum = sum.value();
  if (error == 0) error = file.write_at(s.length, &s, sizeof s);
  if (!read || error != 0) throw RunError(fmt::format("{}: cannot be written: {}", name, error_text(error)));
}

std::string why_not_whole(const std::string& path) {
  if (existing(path).special()) return "cannot be read: not a regular file";
  DiskFile file;
  if (const int error = file.open(path, DiskFile::Open::read))
    return fmt::format("cannot be read: {}", error_text(error));
  Seal s{0, 0, 0};
  const std::uint64_t length = file.size().value_or(0);
  const bool sealed = length >= sizeof s && file.read_at(length - sizeof s, &s, sizeof s);
  if (!sealed || s.mark != seal_mark)
    return "is not a file of results of this version: an earlier one wrote it, it was changed or cut short, or it is "
           "something else";
  Checksum sum;
  const bool whole = s.length == length - sizeof s && file.add_to(sum, 0, s.length) && sum.value() == s.checksum;
  return whole ? "" : "is damaged: its content does not match its checksum";
}

}  // namespace equipoise::io
