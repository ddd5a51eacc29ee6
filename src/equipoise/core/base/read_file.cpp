// Reads a file in blocks, by calls that a signal ends: those of C++ streams go on waiting.
#include "equipoise/core/base/read_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/interrupted.hpp"

namespace equipoise {

std::string unreadable_because(int error) {
  if (error == ENOENT) return "no such file";
  if (error == EACCES) return "not open to this user";
  return error == EISDIR ? "a directory" : std::strerror(error);
}

FileText read_file(const std::string& path, std::size_t longest) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return {{}, unreadable_because(EISDIR)};
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  std::string text;
  std::array<char, 65536> block;
  while (const std::size_t got = file ? std::fread(block.data(), 1, block.size(), file.get()) : 0) {
    text.append(block.data(), got);
    if (text.size() > longest) return {{}, fmt::format("more than {} MiB", longest >> 20)};
  }
  if (file && !std::ferror(file.get())) return {std::move(text), {}};
  if (errno == EINTR) throw Interrupted(path);
  return {{}, file ? "reading broke off" : unreadable_because(errno)};
}

}  // namespace equipoise
