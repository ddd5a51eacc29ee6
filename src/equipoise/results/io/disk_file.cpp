// Files by system calls, all of them checked.
#include "equipoise/results/io/disk_file.hpp"

#include <algorithm>
#include <cerrno>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "equipoise/results/io/checksum.hpp"

namespace equipoise::io {

namespace {

int failed(bool yes) { return yes ? errno : 0; }

// Calls put(bytes from there, how many) until all is written. `again`: also after a signal, which ends a write or cuts
// it short.
template <class Put>
int write_through(const void* data, std::size_t size, bool again, Put put) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = put(at, size);
    if (written < 0 && errno == EINTR && again) continue;
    if (written < 0) return errno;
    if (!again && static_cast<std::size_t>(written) < size) return EINTR;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return 0;
}

}  // namespace

DiskFile::~DiskFile() { (void)close(); }

int DiskFile::open(const std::string& path, Open how) {
  (void)close();
  const int flags = how == Open::read     ? O_RDONLY
                    : how == Open::write  ? O_WRONLY
                    : how == Open::update ? O_RDWR | O_CREAT
                                          : O_WRONLY | O_CREAT | O_EXCL;
  file_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  return failed(file_ < 0);
}

int DiskFile::close() {
  if (file_ < 0) return 0;
  const int file = file_;
  file_ = -1;
  return failed(::close(file) != 0);
}

bool DiskFile::lock() const { return flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

std::optional<std::uint64_t> DiskFile::size() const {
  struct stat now {};
  if (fstat(file_, &now) != 0) return {};
  return static_cast<std::uint64_t>(now.st_size);
}

bool DiskFile::is_named(const std::string& path) const {
  struct stat mine {
  }, named{};
  return fstat(file_, &mine) == 0 && stat(path.c_str(), &named) == 0 && mine.st_ino == named.st_ino;
}

bool DiskFile::read_at(std::uint64_t offset, void* data, std::size_t size) const {
  char* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = pread(file_, at, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    offset += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool DiskFile::add_to(Checksum& sum, std::uint64_t offset, std::uint64_t size) const {
  std::vector<char> part(std::min<std::uint64_t>(size, 1 << 20));
  for (std::uint64_t at = 0; at < size; at += part.size()) {
    part.resize(std::min<std::uint64_t>(part.size(), size - at));
    if (!read_at(offset + at, part.data(), part.size())) return false;
    sum.add(part.data(), part.size());
  }
  return true;
}

int DiskFile::write_at(std::uint64_t offset, const void* data, std::size_t size) const {
  return write_through(data, size, true, [&](const char* at, std::size_t left) {
    const ssize_t written = pwrite(file_, at, left, static_cast<off_t>(offset));
    if (written > 0) offset += static_cast<std::uint64_t>(written);
    return written;
  });
}

int DiskFile::write(const std::string& text) const {
  struct stat now {};
  const bool regular = fstat(file_, &now) == 0 && S_ISREG(now.st_mode);
  return write_through(text.data(), text.size(), regular,
                       [&](const char* at, std::size_t left) { return ::write(file_, at, left); });
}

int DiskFile::cut(std::uint64_t size) const { return failed(ftruncate(file_, static_cast<off_t>(size)) != 0); }

// On macOS fsync() ends when the drive has the data, which may keep it in its own memory; F_FULLFSYNC asks the drive to
// write it (fsync(2) of macOS). File systems that do not know it get fsync().
int DiskFile::to_disk([[maybe_unused]] bool all) const {
#if defined(__APPLE__)
  return fcntl(file_, F_FULLFSYNC) != -1 ? 0 : failed(fsync(file_) != 0);
#else
  return failed((all ? fsync(file_) : fdatasync(file_)) != 0);
#endif
}

int DiskFile::set_permissions(unsigned bits) const { return failed(fchmod(file_, static_cast<mode_t>(bits)) != 0); }

Existing existing(const std::string& path) {
  struct stat old {};
  if (stat(path.c_str(), &old) != 0) return {};
  return {true, S_ISREG(old.st_mode), static_cast<unsigned>(old.st_mode) & 07777u};
}

int remove_file(const std::string& path) { return failed(unlink(path.c_str()) != 0); }

int may_write(const std::string& path) { return failed(access(path.c_str(), W_OK) != 0); }

long process_number() { return getpid(); }

}  // namespace equipoise::io
