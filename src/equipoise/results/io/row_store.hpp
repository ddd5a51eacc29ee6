// A store of rows of numbers: starts of an ensemble, pixels of a map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/io/store.hpp"

namespace equipoise::io {

/// Rows are numbered from 0. A record of the journal holds rows in a row, column by column. It also holds states of the
/// motions that a run met, and texts.
class RowStore : public Store {
 public:
  struct Layout {
    Journal::Kind rows, text;  ///< kinds of its records
    std::uint64_t most = 0;    ///< rows
    const char* lines = "";    ///< first dimension of the finished results
    std::size_t of_line = 1;   ///< rows in each of its places
    std::vector<StoredColumn> columns{};
    std::size_t components = 0;  ///< of a state
  };
  RowStore(const std::string& path, const std::string& identity, const Words& words, const Layout& layout);

  /// In the order in which they were met, each once: enough to name the motions again.
  const std::vector<std::vector<double>>& discoveries() const { return discoveries_; }
  void append_attractor_search(const std::vector<double>& state);
  /// Removes the journal: all that is needed of it is in the finished results.
  void forget();

  /// Replaces those of the values of rows first .. first + count - 1 that are known; of a row that was appended more
  /// than once, they are the last ones. Whole lines.
  void read(std::size_t column, std::uint64_t first, std::size_t count, double* values) const;

 protected:
  /// Calls value(column, place) for all values in all columns.
  void append_rows(Journal::Record record, const std::function<double(std::size_t column, std::size_t place)>& value);
  void append_text(std::uint64_t number, const std::string& text);

  /// Rows that the finished results hold, or have room for.
  std::uint64_t finished() const { return finished_; }
  /// Where the journal has rows.
  const std::vector<Journal::Record>& new_rows() const { return rows_; }
  /// All values of one of them in a column.
  std::vector<double> values_in(const Journal::Record& rows, std::size_t column) const;
  /// Its texts, by number.
  const std::vector<std::pair<std::uint64_t, std::string>>& texts() const { return texts_; }

 private:
  void open_columns();
  void take(const Journal::Record& record);
  void read_rows(const Journal::Record& rows, std::size_t column, std::uint64_t skipped, std::size_t count,
                 double* values) const;

  const Layout layout_;
  std::size_t row_bytes_ = 0;
  std::vector<std::size_t> before_;  // bytes of a row in the columns before each
  std::vector<int> variables_;       // of the columns, in the finished results
  std::uint64_t finished_ = 0;
  std::vector<Journal::Record> rows_;
  std::vector<std::pair<std::uint64_t, std::string>> texts_;
  std::vector<std::vector<double>> discoveries_;
};

}  // namespace equipoise::io
