// Rows of finished results and of the journal, read as one.
#include "equipoise/results/io/row_store.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"

namespace equipoise::io {

RowStore::RowStore(const std::string& path, const std::string& identity, const Words& words, const Layout& layout)
    : Store(path, identity, words), layout_(layout) {
  for (const StoredColumn& c : layout_.columns) {
    before_.push_back(row_bytes_);
    with_type(c.type, [&]<class T>(T) { row_bytes_ += c.width * sizeof(T); });
  }
  if (results()) reading([this] { open_columns(); });
  for (const Journal::Record& record : records()) take(record);
}

void RowStore::open_columns() {
  const std::size_t lines = results()->length(layout_.lines), count = results()->length("discovery");
  finished_ = lines * layout_.of_line;
  for (const StoredColumn& c : layout_.columns) {
    std::vector<std::size_t> shape{lines};
    if (!c.along.empty()) shape.push_back(layout_.of_line * c.width);
    variables_.push_back(results()->variable(c.name, netcdf_type(c.type), shape));
  }
  if (count == 0) return;
  const std::size_t width = layout_.components;
  const auto states = read_column(*results(), "discovery_state", DataColumn::Type::real, {count, width});
  for (auto at = states.begin(); at != states.end(); at += static_cast<std::ptrdiff_t>(width))
    discoveries_.emplace_back(at, at + static_cast<std::ptrdiff_t>(width));
}

// Records may come from anywhere: a checksum does not say what wrote them.
void RowStore::take(const Journal::Record& record) {
  constexpr std::uint64_t longest = 1000;
  const bool in_place = record.first < layout_.most && record.count <= layout_.most - record.first;
  if (record.kind == layout_.rows && in_place && record.count > 0 && record.bytes == record.count * row_bytes_) {
    rows_.push_back(record);
  } else if (record.kind == layout_.text && record.bytes <= longest) {
    texts_.emplace_back(record.first, display_lines(payload<std::string>(record)));
  } else if (record.kind == Journal::Kind::discovery && record.bytes == layout_.components * sizeof(double)) {
    auto state = payload<std::vector<double>>(record);
    if (std::find(discoveries_.begin(), discoveries_.end(), state) == discoveries_.end())
      discoveries_.push_back(std::move(state));
  } else {
    refuse(part(), "holds something else");
  }
}

void RowStore::forget() {
  Store::forget();
  rows_.clear();
  texts_.clear();
}

void RowStore::read(std::size_t column, std::uint64_t first, std::size_t count, double* values) const {
  const StoredColumn& c = layout_.columns[column];
  with_type(c.type, [&]<class T>(T) {
    std::vector<T> part;
    // Reads the rows from begin to end among them, if there are any.
    const auto read_part = [&](std::uint64_t begin, std::uint64_t end, const auto& of) {
      begin = std::max(begin, first);
      end = std::min<std::uint64_t>(end, first + count);
      if (begin >= end) return;
      part.resize((end - begin) * c.width);
      of(begin, end);
      std::copy(part.begin(), part.end(), values + (begin - first) * c.width);
    };
    read_part(0, finished_, [&](std::uint64_t begin, std::uint64_t end) {
      std::vector<std::size_t> start{begin / layout_.of_line}, size{(end - begin) / layout_.of_line};
      if (!c.along.empty()) start.push_back(0), size.push_back(layout_.of_line * c.width);
      results()->read(variables_[column], start, size, part.data());
    });
    for (const Journal::Record& record : rows_)
      read_part(record.first, record.first + record.count, [&](std::uint64_t begin, std::uint64_t) {
        const std::uint64_t skipped = (begin - record.first) * c.width * sizeof(T);
        read_payload(record, before_[column] * record.count + skipped, part.size() * sizeof(T), part.data());
      });
  });
}

std::vector<double> RowStore::values_in(const Journal::Record& rows, std::size_t column) const {
  std::vector<double> numbers;
  with_type(layout_.columns[column].type, [&]<class T>(T) {
    std::vector<T> values(rows.count * layout_.columns[column].width);
    read_payload(rows, before_[column] * rows.count, values.size() * sizeof(T), values.data());
    numbers.assign(values.begin(), values.end());
  });
  return numbers;
}

void RowStore::append_rows(Journal::Record record,
                           const std::function<double(std::size_t column, std::size_t place)>& value) {
  std::vector<char> bytes;
  bytes.reserve(record.count * row_bytes_);
  for (std::size_t k = 0; k < layout_.columns.size(); ++k)
    with_type(layout_.columns[k].type, [&]<class T>(T) {
      for (std::size_t place = 0; place < record.count * layout_.columns[k].width; ++place) {
        const T one = static_cast<T>(value(k, place));
        const char* from = reinterpret_cast<const char*>(&one);
        bytes.insert(bytes.end(), from, from + sizeof one);
      }
    });
  record.kind = layout_.rows;
  rows_.push_back(append(record, bytes.data(), bytes.size()));
}

void RowStore::append_text(std::uint64_t number, const std::string& text) {
  append({.kind = layout_.text, .first = number, .count = 1}, text.data(), text.size());
}

void RowStore::append_attractor_search(const std::vector<double>& state) {
  append({.kind = Journal::Kind::discovery, .first = discoveries_.size(), .count = 1}, state.data(),
         state.size() * sizeof(double));
  discoveries_.push_back(state);
}

}  // namespace equipoise::io
