// Reads studies from files.
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_file.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

namespace {
// The longest study written so far is a thousandth of this.
constexpr std::size_t longest_study = std::size_t{16} << 20;

// By its first bytes: the classic formats, and NetCDF-4, which is HDF5.
bool is_netcdf(const std::string& bytes) {
  return (bytes.starts_with("CDF") && bytes.size() > 3 && bytes[3] < ' ') || bytes.starts_with("\x89HDF");
}
}  // namespace

std::string read_study_text(const std::string& path) {
  const auto reject = [&](const std::string& why) {
    throw InputError(display_text(path), "", "",
                     fmt::format("cannot be read ({}); must be a readable study file (TOML)", why));
  };
  const auto [text, problem] = read_file(path, longest_study);
  if (!problem.empty()) reject(problem);
  if (is_netcdf(text)) reject("NetCDF, a file of results: \"equipoise inspect\" reads it");
  return text;
}

Study read_study(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_study(read_study_text(path), display_text(path), overrides);
}

}  // namespace equipoise
