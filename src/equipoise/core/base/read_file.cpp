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

#include "equipoise/core/words/core.hpp"

namespace equipoise {

std::string unreadable_because(int error) {
  if (error == ENOENT) return words::core::no_file;
  if (error == EACCES) return words::core::no_permission;
  return error == EISDIR ? words::core::directory : std::strerror(error);
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
    if (text.size() > longest) return {{}, fmt::format(words::core::file_too_long, longest >> 20)};
  }
  if (file.bad()) return {{}, words::core::reading_broke_off};
  return {std::move(text), {}};
}

}  // namespace equipoise
