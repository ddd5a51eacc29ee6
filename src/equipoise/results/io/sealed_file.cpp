// The seal: a mark, the length and the checksum of everything before it. Other readers ignore it.
#include "equipoise/results/io/sealed_file.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/checksum.hpp"
#include "equipoise/results/io/disk_file.hpp"
#include "equipoise/results/io/replacement.hpp"

namespace equipoise::io {

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
