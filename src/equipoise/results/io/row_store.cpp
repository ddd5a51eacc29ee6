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
  const std::size_t width = c.width;
  const std::uint64_t end = first + count;
  if (first < finished_)
    with_type(c.type, [&]<class T>(T) {
      const std::uint64_t rows = std::min(end, finished_) - first;
      std::vector<T> there(rows * width);
      std::vector<std::size_t> start{first / layout_.of_line}, size{rows / layout_.of_line};
      if (!c.along.empty()) start.push_back(0), size.push_back(layout_.of_line * width);
      results()->read(variables_[column], start, size, there.data());
      std::copy(there.begin(), there.end(), values);
    });
  for (const Journal::Record& record : rows_) {
    const std::uint64_t from = std::max(record.first, first), to = std::min(record.first + record.count, end);
    if (from < to) read_rows(record, column, from - record.first, to - from, values + (from - first) * width);
  }
}

void RowStore::read_rows(const Journal::Record& rows, std::size_t column, std::uint64_t skipped, std::size_t count,
                         double* values) const {
  const std::size_t width = layout_.columns[column].width;
  with_type(layout_.columns[column].type, [&]<class T>(T) {
    std::vector<T> there(count * width);
    const std::uint64_t begin = before_[column] * rows.count + skipped * width * sizeof(T);
    read_payload(rows, begin, there.size() * sizeof(T), there.data());
    std::copy(there.begin(), there.end(), values);
  });
}

std::vector<double> RowStore::values_in(const Journal::Record& rows, std::size_t column) const {
  std::vector<double> values(rows.count * layout_.columns[column].width);
  read_rows(rows, column, 0, rows.count, values.data());
  return values;
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
