// The finished part of a slice in NetCDF and new pixels in a journal, read as one.
#include "equipoise/analyses/basin_slices/slice_store.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "equipoise/analyses/words/sweeps.hpp"
#include "equipoise/core/base/bytes.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/kept_search_log.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

namespace {

// A pixel in a record: position, outcome, numbers.
template <class Bytes, class Position, Like<SlicePixel> Pixel>
void pass_pixel(Bytes& b, Position& position, Pixel& pixel, bool one_rotor) {
  b(position, pixel.code);
  visit_pixel_numbers(one_rotor, [&](std::size_t, float SlicePixel::*value) { b(pixel.*value); });
}

std::size_t pixel_bytes(bool one_rotor) {
  BytesOut out;
  const SlicePixel pixel;
  const std::uint32_t position = 0;
  pass_pixel(out, position, pixel, one_rotor);
  return out.take().size();
}

}  // namespace

SliceStore::SliceStore(const std::string& path, const io::SliceFileHeader& header)
    : path_(io::results_path(path, words::sweeps::same_map)),
      header_(header),
      size_(static_cast<std::uint64_t>(header.x.pixels) * static_cast<std::uint64_t>(header.y.pixels)),
      journal_(path_ + ".part", path_, io::identity_of(header)) {
  open_results();
  require_same(journal_.identity(), path_ + ".part");
  if (!complete()) {
    for (const io::Journal::Record& record : journal_.records()) take(record);
    notes_ = io::notes_kept_in(journal_);
  } else if (!journal_.records().empty()) {  // killed before the journal was removed
    journal_.remove();
  }
}

void SliceStore::require_same(const std::string& there, const std::string& of) const {
  io::require_same(there, io::identity_of(header_), of, words::sweeps::this_map, words::sweeps::same_map);
}

void SliceStore::refuse_part() const {
  throw InputError(path_ + ".part", "", "", fmt::format(words::sweeps::part_of_another, path_));
}

void SliceStore::open_results() {
  if (!std::filesystem::exists(path_)) return;
  file_.emplace(path_);
  require_same(file_->identity(), path_);
  const SliceAxis &x = file_->x(), &y = file_->y();
  if (x.pixels != header_.x.pixels || y.pixels != header_.y.pixels)
    throw InputError(path_, "", "",
                     fmt::format(words::sweeps::other_size, x.pixels, y.pixels, header_.x.pixels, header_.y.pixels));
  codes_ = file_->codes();
  discoveries_ = file_->discoveries(header_.components);
}

void SliceStore::take(const io::Journal::Record& record) {
  using Kind = io::Journal::Kind;
  if (record.kind == Kind::note) return;
  if (record.kind == Kind::outcome_name) return take_name(record);
  if (record.kind == Kind::pixels) return take_pixels(record);
  if (record.kind != Kind::discovery || record.bytes != header_.components * sizeof(double)) refuse_part();
  std::vector<double> state(header_.components);
  journal_.read(record, 0, record.bytes, state.data());
  if (std::find(discoveries_.begin(), discoveries_.end(), state) == discoveries_.end()) discoveries_.push_back(state);
}

// Code, name and alias, one per line.
void SliceStore::take_name(const io::Journal::Record& record) {
  constexpr std::uint64_t longest = 1000;
  if (record.bytes > longest || record.first > static_cast<std::uint64_t>(std::numeric_limits<short>::max()))
    refuse_part();
  std::string text(record.bytes, '\0');
  journal_.read(record, 0, record.bytes, text.data());
  text = display_lines(text);
  const std::size_t line = std::min(text.find('\n'), text.size());
  codes_.push_back(
      {static_cast<short>(record.first), text.substr(0, line), text.substr(std::min(line + 1, text.size())), {}});
}

void SliceStore::take_pixels(const io::Journal::Record& record) {
  if (record.count == 0 || record.count > size_ || record.bytes != record.count * pixel_bytes(header_.one_rotor))
    refuse_part();
  Piece piece{std::numeric_limits<std::uint32_t>::max(), 0, record};
  visit(piece, [&](std::uint32_t at, const SlicePixel&) {
    piece.first = std::min(piece.first, at);
    piece.last = std::max(piece.last, at);
  });
  if (piece.last >= size_) refuse_part();
  pieces_.push_back(piece);
}

void SliceStore::visit(const Piece& piece, const std::function<void(std::uint32_t, const SlicePixel&)>& visit) const {
  constexpr std::uint64_t block = 65536;
  const std::size_t size = pixel_bytes(header_.one_rotor);
  SlicePixel pixel;
  std::uint32_t position = 0;
  for (std::uint64_t begin = 0; begin < piece.record.count; begin += block) {
    const std::uint64_t count = std::min(block, piece.record.count - begin);
    std::vector<char> bytes(count * size);
    journal_.read(piece.record, begin * size, bytes.size(), bytes.data());
    BytesIn in(bytes);
    for (std::uint64_t k = 0; k < count; ++k) {
      pass_pixel(in, position, pixel, header_.one_rotor);
      visit(position, pixel);
    }
  }
}

void SliceStore::for_each_known(const std::function<void(std::uint32_t, short)>& visit_known) const {
  const std::size_t columns = static_cast<std::size_t>(header_.x.pixels);
  std::vector<SlicePixel> row(columns);
  for (int y = 0; file_ && y < header_.y.pixels; ++y) {
    file_->read_rows(y, 1, row.data());
    for (std::size_t x = 0; x < columns; ++x)
      if (row[x].code != not_computed_code)
        visit_known(static_cast<std::uint32_t>(static_cast<std::size_t>(y) * columns + x), row[x].code);
  }
  for (const Piece& piece : pieces_)
    visit(piece, [&](std::uint32_t position, const SlicePixel& pixel) { visit_known(position, pixel.code); });
}

void SliceStore::keep(io::Journal::Record record, const void* payload, std::size_t bytes) {
  try {
    journal_.append(record, payload, bytes);
  } catch (const RunError& e) {
    throw RunError(fmt::format(words::sweeps::kept_so_far, e.what()));
  }
}

void SliceStore::append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) {
  if (positions.empty()) return;
  BytesOut out;
  for (std::size_t k = 0; k < positions.size(); ++k) pass_pixel(out, positions[k], pixels[k], header_.one_rotor);
  const std::vector<char> payload = out.take();
  const auto [first, last] = std::minmax_element(positions.begin(), positions.end());
  keep({.kind = io::Journal::Kind::pixels, .first = *first, .count = positions.size()}, payload.data(), payload.size());
  pieces_.push_back({*first, *last, journal_.records().back()});
}

void SliceStore::append_code(const OutcomeShare& code) {
  const std::string text = code.name + "\n" + code.alias;
  keep({.kind = io::Journal::Kind::outcome_name, .first = static_cast<std::uint64_t>(code.id), .count = 1}, text.data(),
       text.size());
}

void SliceStore::append_attractor_search(const std::vector<double>& state) {
  keep({.kind = io::Journal::Kind::discovery, .first = discoveries_.size(), .count = 1}, state.data(),
       state.size() * sizeof(double));
  discoveries_.push_back(state);
}

void SliceStore::read_rows(int first, int rows, SlicePixel* pixels) const {
  const std::uint64_t columns = static_cast<std::uint64_t>(header_.x.pixels);
  const std::uint32_t low = static_cast<std::uint32_t>(columns * static_cast<std::uint64_t>(first));
  const std::size_t count = columns * static_cast<std::size_t>(rows);
  std::fill(pixels, pixels + count, SlicePixel{});
  if (file_) file_->read_rows(first, rows, pixels);
  const std::uint32_t high = static_cast<std::uint32_t>(low + count - 1);
  for (const Piece& piece : pieces_)
    if (piece.first <= high && piece.last >= low)
      visit(piece, [&](std::uint32_t at, const SlicePixel& pixel) {
        if (at >= low && at <= high) pixels[at - low] = pixel;
      });
}

void SliceStore::finish(const std::function<void(const std::string&)>& write, bool complete) {
  try {
    journal_.require_sound();
    write(path_);
  } catch (const RunError& e) {
    throw RunError(fmt::format(words::sweeps::kept_in_part, e.what(), path_));
  }
  io::leave_notes(journal_, complete);
}

}  // namespace equipoise
