// What is finished of a map in NetCDF, what is new in a journal, read as one.
#include "equipoise/maps/map_store.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "equipoise/base/error.hpp"
#include "equipoise/base/notes.hpp"
#include "equipoise/files/journal.hpp"
#include "equipoise/files/kept_notes.hpp"
#include "equipoise/store/result_identity.hpp"

namespace equipoise {

namespace {

constexpr const char* same_map = "must be a new file, or one of the same map";

// A pixel as a record has it: its place, where places do not follow one another, then what it came to.
class PixelRecord {
 public:
  PixelRecord(bool one_rotor, bool places) : numbers_(one_rotor ? 2 : 4), places_(places) {}

  std::size_t bytes() const { return (places_ ? sizeof(std::uint32_t) : 0) + sizeof(short) + numbers_ * sizeof(float); }
  void put(char* to, std::uint32_t position, const MapPixel& p) const {
    if (places_) to = copy(to, &position, sizeof position);
    to = copy(to, &p.code, sizeof p.code);
    const float numbers[]{p.time, p.r_max, p.balance_margin, p.balance_growth};
    copy(to, numbers, numbers_ * sizeof(float));
  }
  void get(const char* from, std::uint32_t& position, MapPixel& p) const {
    if (places_) std::memcpy(&position, from, sizeof position);
    if (places_) from += sizeof position;
    std::memcpy(&p.code, from, sizeof p.code);
    float* const numbers[]{&p.time, &p.r_max, &p.balance_margin, &p.balance_growth};
    for (std::size_t k = 0; k < numbers_; ++k)
      std::memcpy(numbers[k], from + sizeof p.code + k * sizeof(float), sizeof(float));
    p.computed = true;
  }

 private:
  static char* copy(char* to, const void* from, std::size_t bytes) {
    std::memcpy(to, from, bytes);
    return to + bytes;
  }
  std::size_t numbers_;
  bool places_;
};

}  // namespace

struct MapStore::State {
  // Pixels of a record of the journal; between the first and the last one there may be others.
  struct Piece {
    std::uint32_t first = 0, last = 0;
    bool places = false;
    store::Journal::Record record;
  };
  using Visit = std::function<void(std::uint32_t, const MapPixel&)>;

  std::string path;
  store::MapFileHeader header;
  std::uint64_t size = 0;  // of the map, in pixels
  std::vector<OutcomeShare> codes;
  std::vector<std::vector<double>> discoveries;
  std::vector<Piece> pieces;
  std::optional<store::MapReader> file;
  std::optional<store::Journal> journal;
  std::unique_ptr<Notes> notes;

  void require_same(const std::string& there, const std::string& of) const;
  void open_results();
  void take(const store::Journal::Record& record);
  void take_name(const store::Journal::Record& record);
  void take_pixels(const store::Journal::Record& record);
  [[noreturn]] void refuse_part() const;
  void append(store::Journal::Record record, const void* payload, std::size_t bytes);
  void visit(const Piece& piece, std::uint32_t low, std::uint32_t high, const Visit& visit) const;
};

void MapStore::State::require_same(const std::string& there, const std::string& of) const {
  store::require_same(there, store::identity_of(header), of, "this map", same_map);
}

void MapStore::State::refuse_part() const {
  throw InputError(path + ".part", "", "", fmt::format("does not belong to {}; must be removed first", path));
}

void MapStore::State::open_results() {
  if (!std::filesystem::exists(path)) return;
  file.emplace(path);
  require_same(file->identity(), path);
  codes = file->codes();
  discoveries = file->discoveries();
}

void MapStore::State::take(const store::Journal::Record& record) {
  using Kind = store::Journal::Kind;
  if (record.kind == Kind::note) return;
  if (record.kind == Kind::outcome_name) return take_name(record);
  if (record.kind == Kind::pixels) return take_pixels(record);
  if (record.kind != Kind::discovery || record.first > discoveries.size() || record.bytes % sizeof(double) != 0)
    refuse_part();
  if (record.first < discoveries.size()) return;  // in the results since
  std::vector<double>& state = discoveries.emplace_back(record.bytes / sizeof(double));
  journal->read(record, 0, record.bytes, state.data());
}

// Code, name and alias, a line each.
void MapStore::State::take_name(const store::Journal::Record& record) {
  constexpr std::uint64_t longest = 1000;
  if (record.bytes > longest || record.first > static_cast<std::uint64_t>(std::numeric_limits<short>::max()))
    refuse_part();
  std::string text(record.bytes, '\0');
  journal->read(record, 0, record.bytes, text.data());
  const std::size_t line = std::min(text.find('\n'), text.size());
  codes.push_back(
      {static_cast<short>(record.first), text.substr(0, line), text.substr(std::min(line + 1, text.size())), {}});
}

void MapStore::State::take_pixels(const store::Journal::Record& record) {
  const auto fits = [&](bool places) {
    return record.count <= size && record.bytes == record.count * PixelRecord(header.one_rotor, places).bytes();
  };
  Piece piece{static_cast<std::uint32_t>(record.first), 0, !fits(false), record};
  if (record.count == 0 || record.first >= size || !(fits(false) || fits(true))) refuse_part();
  piece.last = static_cast<std::uint32_t>(record.first + record.count - 1);
  if (piece.places) {
    std::uint32_t last = 0;
    visit(piece, 0, std::numeric_limits<std::uint32_t>::max(),
          [&](std::uint32_t at, const MapPixel&) { last = std::max(last, at); });
    piece.last = last;
  }
  if (piece.last >= size) refuse_part();
  pieces.push_back(piece);
}

// Its pixels from `low` to `high`.
void MapStore::State::visit(const Piece& piece, std::uint32_t low, std::uint32_t high, const Visit& visit) const {
  constexpr std::uint64_t block = 65536;
  const PixelRecord form(header.one_rotor, piece.places);
  std::uint64_t begin = 0, end = piece.record.count;
  if (!piece.places) {
    begin = low > piece.first ? low - piece.first : 0;
    end = std::min<std::uint64_t>(end, high >= piece.first ? std::uint64_t{high} - piece.first + 1 : 0);
  }
  std::vector<char> bytes;
  MapPixel pixel;
  for (; begin < end; begin += block) {
    const std::uint64_t count = std::min(block, end - begin);
    bytes.resize(count * form.bytes());
    journal->read(piece.record, begin * form.bytes(), bytes.size(), bytes.data());
    for (std::uint64_t k = 0; k < count; ++k) {
      std::uint32_t position = static_cast<std::uint32_t>(piece.record.first + begin + k);
      form.get(bytes.data() + k * form.bytes(), position, pixel);
      if (position >= low && position <= high) visit(position, pixel);
    }
  }
}

MapStore::MapStore(const std::string& path, const store::MapFileHeader& header) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = store::results_path(path, same_map);
  s.header = header;
  s.size = static_cast<std::uint64_t>(header.x.pixels) * static_cast<std::uint64_t>(header.y.pixels);
  s.journal.emplace(s.path + ".part", s.path, store::identity_of(header));
  s.open_results();
  s.require_same(s.journal->identity(), s.path + ".part");
  if (!complete()) {
    for (const store::Journal::Record& record : s.journal->records()) s.take(record);
    s.notes = store::notes_kept_in(*s.journal);
  } else if (!s.journal->records().empty()) {  // a kill came before that
    s.journal->remove();
  }
}

Notes& MapStore::notes() { return *state_->notes; }

MapStore::~MapStore() = default;

bool MapStore::complete() const { return state_->file && state_->file->complete(); }

bool MapStore::unfinished() const { return !state_->pieces.empty(); }

const std::vector<OutcomeShare>& MapStore::codes() const { return state_->codes; }

const std::vector<std::vector<double>>& MapStore::discoveries() const { return state_->discoveries; }

void MapStore::for_each_known(const std::function<void(std::uint32_t, short)>& visit) const {
  const State& s = *state_;
  const std::size_t columns = static_cast<std::size_t>(s.header.x.pixels);
  std::vector<MapPixel> row(columns);
  for (int y = 0; s.file && y < s.header.y.pixels; ++y) {
    s.file->read_rows(y, 1, row.data());
    for (std::size_t x = 0; x < columns; ++x)
      if (row[x].computed) visit(static_cast<std::uint32_t>(static_cast<std::size_t>(y) * columns + x), row[x].code);
  }
  for (const State::Piece& piece : s.pieces)
    s.visit(piece, 0, std::numeric_limits<std::uint32_t>::max(),
            [&](std::uint32_t position, const MapPixel& pixel) { visit(position, pixel.code); });
}

void MapStore::State::append(store::Journal::Record record, const void* payload, std::size_t bytes) {
  try {
    journal->append(record, payload, bytes);
  } catch (const RunError& e) {
    throw RunError(fmt::format("{}; what was computed before is kept, and the same command goes on from it", e.what()));
  }
}

void MapStore::append(const std::vector<std::uint32_t>& positions, const std::vector<MapPixel>& pixels) {
  if (positions.empty()) return;
  State& s = *state_;
  const auto [first, last] = std::minmax_element(positions.begin(), positions.end());
  bool places = false;
  for (std::size_t k = 1; k < positions.size(); ++k) places = places || positions[k] != positions[k - 1] + 1;
  const PixelRecord form(s.header.one_rotor, places);
  std::vector<char> payload(positions.size() * form.bytes());
  for (std::size_t k = 0; k < positions.size(); ++k)
    form.put(payload.data() + k * form.bytes(), positions[k], pixels[k]);
  s.append({.kind = store::Journal::Kind::pixels, .first = *first, .count = positions.size()}, payload.data(),
           payload.size());
  s.pieces.push_back({*first, *last, places, s.journal->records().back()});
}

void MapStore::append_code(const OutcomeShare& code) {
  const std::string text = code.name + "\n" + code.alias;
  state_->append({.kind = store::Journal::Kind::outcome_name, .first = static_cast<std::uint64_t>(code.id), .count = 1},
                 text.data(), text.size());
}

void MapStore::append_discovery(const std::vector<double>& state) {
  state_->append({.kind = store::Journal::Kind::discovery, .first = state_->discoveries.size(), .count = 1},
                 state.data(), state.size() * sizeof(double));
  state_->discoveries.push_back(state);
}

void MapStore::read_rows(int first, int rows, MapPixel* pixels) const {
  const State& s = *state_;
  const std::uint64_t columns = static_cast<std::uint64_t>(s.header.x.pixels);
  const std::uint32_t low = static_cast<std::uint32_t>(columns * static_cast<std::uint64_t>(first));
  const std::size_t count = columns * static_cast<std::size_t>(rows);
  std::fill(pixels, pixels + count, MapPixel{});
  if (s.file) {
    s.file->read_rows(first, rows, pixels);
    for (std::size_t k = 0; !s.file->complete() && k < count; ++k)
      if (!pixels[k].computed) pixels[k] = MapPixel{};
  }
  const std::uint32_t high = static_cast<std::uint32_t>(low + count - 1);
  for (const State::Piece& piece : s.pieces)
    if (piece.first <= high && piece.last >= low)
      s.visit(piece, low, high, [&](std::uint32_t at, const MapPixel& pixel) { pixels[at - low] = pixel; });
}

void MapStore::finish(const std::function<void(const std::string&)>& write, bool complete) {
  State& s = *state_;
  try {
    write(s.path);
  } catch (const RunError& e) {
    throw RunError(
        fmt::format("{}; what was computed is kept in {}.part and put in place by the same command", e.what(), s.path));
  }
  store::leave_notes(*s.journal, complete);
}

}  // namespace equipoise
