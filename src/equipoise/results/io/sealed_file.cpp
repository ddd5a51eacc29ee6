// The seal: a mark, the length and the checksum of everything before it. Other readers ignore it.
#include "equipoise/results/io/sealed_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/checksum.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise::io {

namespace {

constexpr std::uint64_t seal_mark = 0x314C414553505145;

struct Seal {
  std::uint64_t mark = seal_mark, length = 0, checksum = 0;
};

// Checksum of the first `length` bytes; false if there are fewer.
bool sum_up(std::ifstream& file, std::uint64_t length, Checksum& sum) {
  std::vector<char> part(1 << 20);
  while (length > 0) {
    const std::uint64_t wanted = std::min<std::uint64_t>(length, part.size());
    if (!file.read(part.data(), static_cast<std::streamsize>(wanted))) return false;
    sum.add(part.data(), wanted);
    length -= wanted;
  }
  return true;
}

std::uint64_t length_of(std::ifstream& file) {
  file.seekg(0, std::ios::end);
  const std::streamoff length = file.tellg();
  file.seekg(0);
  return length > 0 ? static_cast<std::uint64_t>(length) : 0;
}

}  // namespace

void seal(const std::string& path, const std::string& name) {
  std::ifstream file(path, std::ios::binary);
  Seal s;
  s.length = length_of(file);
  Checksum sum;
  const bool read = sum_up(file, s.length, sum);
  s.checksum = sum.value();
  errno = 0;
  std::ofstream end(path, std::ios::binary | std::ios::app);
  end.write(reinterpret_cast<const char*>(&s), sizeof s);
  end.close();
  if (!read || !end) throw RunError(fmt::format("{}: cannot be written: {}", name, error_text(errno)));
}

std::string why_not_whole(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::uint64_t length = length_of(file);
  if (!file) return fmt::format("cannot be read: {}", error_text(errno));
  Seal s{0, 0, 0};
  if (length >= sizeof s) {
    file.seekg(static_cast<std::streamoff>(length - sizeof s));
    file.read(reinterpret_cast<char*>(&s), sizeof s);
    file.seekg(0);
  }
  if (s.mark != seal_mark) return words::files::results_of_other_version;
  Checksum sum;
  const bool whole = s.length == length - sizeof s && sum_up(file, s.length, sum) && sum.value() == s.checksum;
  return whole ? "" : words::files::checksum_differs;
}

}  // namespace equipoise::io
