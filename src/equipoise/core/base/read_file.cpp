// Reads a file in blocks.
#include "equipoise/core/base/read_file.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>


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
  std::ifstream file(path, std::ios::binary);
  if (!file) return {{}, unreadable_because(errno)};
  std::string text;
  std::array<char, 65536> block;
  while (file.read(block.data(), block.size()), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > longest) return {{}, fmt::format("more than {} MiB", longest >> 20)};
  }
  if (file.bad()) return {{}, "reading broke off"};
  return {std::move(text), {}};
}

}  // namespace equipoise
