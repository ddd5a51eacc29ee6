// Pixels as rows of numbers: records hold pixels that follow each other.
#include "equipoise/analyses/basin_slices/slice_store.hpp"

#include <algorithm>
#include <limits>

#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"

namespace equipoise {

namespace {

io::RowStore::Layout layout_of(const io::SliceFileHeader& header) {
  return {.rows = io::Journal::Kind::pixels,
          .text = io::Journal::Kind::outcome_name,
          .most = pixels_of(header.x, header.y),
          .lines = "y",
          .of_line = static_cast<std::size_t>(header.x.pixels),
          .columns = io::pixel_columns(header.one_rotor),
          .components = header.components};
}

}  // namespace

SliceStore::SliceStore(const std::string& path, const io::SliceFileHeader& header)
    : RowStore(path, io::identity_of(header), {"this map", "must be a new file, or one of the same map"},
               layout_of(header)),
      header_(header) {
  reading([this] {
    if (!results()) return;
    codes_ = io::read_outcome_kinds(*results(), "");
    header_.flipped = io::read_flipped(*results());
    std::erase_if(codes_, [](const OutcomeShare& c) { return c.id <= 0; });
    if (finished() != pixels_of(header_.x, header_.y))
      refuse(this->path(), "is damaged: it has another number of pixels");
  });
  if (says_complete()) forget();  // killed before the journal was removed
  // Name and alias, one per line.
  for (const auto& [code, text] : texts()) {
    if (code > static_cast<std::uint64_t>(std::numeric_limits<short>::max())) refuse(part(), "holds something else");
    const std::size_t line = std::min(text.find('\n'), text.size());
    codes_.push_back({static_cast<short>(code),
                      display_text(text.substr(0, line)),
                      display_text(text.substr(std::min(line + 1, text.size()))),
                      {}});
  }
}

// Of pixels that are not computed all numbers are missing.
void SliceStore::read_pixels(std::size_t column, std::uint64_t first, std::size_t count, double* values) const {
  std::fill_n(values, count, column == 0 ? not_computed_code : std::numeric_limits<double>::quiet_NaN());
  read(column, first, count, values);
}

void SliceStore::for_each_known(const std::function<void(std::uint32_t, short)>& visit) const {
  if (!results() && !unfinished()) return;
  constexpr std::size_t lines = 64;  // read at once
  const std::size_t each = lines * static_cast<std::size_t>(header_.x.pixels);
  std::vector<double> codes;
  for (std::uint64_t first = 0; first < pixels_of(header_.x, header_.y); first += codes.size()) {
    codes.resize(std::min<std::uint64_t>(each, pixels_of(header_.x, header_.y) - first));
    read_pixels(0, first, codes.size(), codes.data());
    for (std::size_t k = 0; k < codes.size(); ++k)
      if (codes[k] != not_computed_code) visit(static_cast<std::uint32_t>(first + k), static_cast<short>(codes[k]));
  }
}

void SliceStore::append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) {
  for (std::size_t begin = 0, end = 0; begin < positions.size(); begin = end) {
    for (end = begin + 1; end < positions.size() && positions[end] == positions[end - 1] + 1;) ++end;
    append_rows({.first = positions[begin], .count = end - begin}, [&](std::size_t column, std::size_t place) {
      const SlicePixel& pixel = pixels[begin + place];
      return column == 0 ? static_cast<double>(pixel.code) : pixel.*pixel_numbers[column - 1].value;
    });
  }
}

void SliceStore::append_code(const OutcomeShare& code) {
  append_text(static_cast<std::uint64_t>(code.id), code.name + "\n" + code.alias);
}

void SliceStore::read_rows(int first, int rows, SlicePixel* pixels) const {
  const std::size_t columns = static_cast<std::size_t>(header_.x.pixels);
  std::vector<double> values(columns * static_cast<std::size_t>(rows));
  std::fill_n(pixels, values.size(), SlicePixel{});
  const auto read_into = [&](std::size_t column, auto SlicePixel::*member) {
    read_pixels(column, columns * static_cast<std::size_t>(first), values.size(), values.data());
    for (std::size_t k = 0; k < values.size(); ++k)
      pixels[k].*member = static_cast<std::remove_reference_t<decltype(pixels[k].*member)>>(values[k]);
  };
  read_into(0, &SlicePixel::code);
  visit_pixel_numbers(header_.one_rotor, [&](std::size_t k, const PixelNumber& n) { read_into(1 + k, n.value); });
}

void SliceStore::finish(const std::vector<OutcomeShare>& codes, const std::map<short, OutcomeShare>& seen,
                        bool complete, const std::optional<Share>& flipped) {
  header_.flipped = flipped;
  const auto values = [&](std::size_t column) -> DataValues {
    return [&, column](std::size_t first, std::size_t count, double* to) {
      read_pixels(column, first, count, to);
      for (std::size_t k = 0; column == 0 && k < count; ++k)
        if (const auto at = seen.find(static_cast<short>(to[k])); at != seen.end()) to[k] = at->second.id;
    };
  };
  Store::finish(
      [&](const std::string& path) {
        io::write_netcdf_file(path, io::slice_dataset(header_, codes, discoveries(), complete, values));
      },
      complete ? Rest::nothing : Rest::notes);
}

}  // namespace equipoise
