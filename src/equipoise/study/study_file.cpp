// Reads studies from files.
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "equipoise/base/display_text.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/words/study.hpp"

namespace equipoise {

namespace {
// The longest study written so far is a thousandth of this. An endless file such as /dev/zero stops here.
constexpr std::size_t longest_study = std::size_t{16} << 20;

// By its first bytes: the classic formats, and NetCDF-4, which is HDF5.
bool is_netcdf(const std::string& bytes) {
  return (bytes.starts_with("CDF") && bytes.size() > 3 && bytes[3] < ' ') || bytes.starts_with("\x89HDF");
}
}  // namespace

std::string read_study_text(const std::string& path) {
  const auto reject = [&](const std::string& why) {
    throw InputError(display_text(path), "", "", fmt::format(words::study::file_unreadable, why));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) reject(words::study::directory);
  std::ifstream file(path, std::ios::binary);
  if (!file) reject(std::filesystem::exists(path, ignored) ? words::study::no_permission : words::study::no_file);
  std::string text;
  std::array<char, 65536> block;
  while (file.read(block.data(), block.size()), file.gcount() > 0) {
    text.append(block.data(), file.gcount());
    if (text.size() > longest_study) reject(fmt::format("more than {} MiB", longest_study >> 20));
  }
  if (file.bad()) reject("reading broke off");
  if (is_netcdf(text)) reject(words::study::results_file);
  return text;
}

Study read_study(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_study(read_study_text(path), display_text(path), overrides);
}

}  // namespace equipoise
