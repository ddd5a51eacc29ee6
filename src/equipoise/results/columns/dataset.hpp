// A result as columns over named dimensions, with attributes: all that a file holds, whatever its format.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/results/columns/column.hpp"

namespace equipoise {

using TextAttributes = std::vector<std::pair<std::string, std::string>>;

/// A value by place, or values from a place on.
template <class T>
concept DataReader = std::invocable<T, std::size_t> || std::invocable<T, std::size_t, std::size_t, double*>;

/// The values of a column by place, the last dimension running fastest; of texts characters. Either a function of the
/// place, or one that puts `count` values from the place `first` on into `to`: whole rows along the first dimension.
class DataValues {
 public:
  DataValues() = default;  ///< nothing is known
  template <DataReader Of>
  DataValues(Of of) {
    if constexpr (std::invocable<Of, std::size_t>)
      read_ = [of = std::move(of)](std::size_t first, std::size_t count, double* to) {
        for (std::size_t k = 0; k < count; ++k) to[k] = static_cast<double>(of(first + k));
      };
    else
      read_ = std::move(of);
  }

  bool known() const { return static_cast<bool>(read_); }
  void read(std::size_t first, std::size_t count, double* to) const { read_(first, count, to); }

 private:
  std::function<void(std::size_t, std::size_t, double*)> read_;
};

struct DataColumn {
  enum class Type { text, byte, small, integer, single, real };

  std::string name, units, long_name;  ///< units: as CF has them, "1" of a pure number
  std::vector<std::size_t> along;      ///< places of its dimensions
  DataValues values;                   ///< not known: every place stays filled
  Type type = Type::real;
  std::optional<double> fill{};  ///< stands where a value is missing
  std::vector<int> flags{};      ///< the values whose names the attribute flag_meanings has
  TextAttributes attributes{};   ///< in addition to units and long_name
};

/// What a store of rows (results/io/row_store.hpp) keeps of every row.
struct StoredColumn : Column {
  DataColumn::Type type = DataColumn::Type::real;
  std::size_t width = 1;  ///< values per row
  std::string along{};    ///< the dimension along which they are stored in files; empty for a single one
};

/// Calls visit(a value of the type that stands for it in memory and in files).
template <class Visit>
void with_type(DataColumn::Type type, const Visit& visit) {
  using Type = DataColumn::Type;
  switch (type) {
    case Type::text:
      return visit(char{});
    case Type::byte:
      return visit(std::int8_t{});
    case Type::small:
      return visit(std::int16_t{});
    case Type::integer:
      return visit(int{});
    case Type::single:
      return visit(float{});
    case Type::real:
      return visit(double{});
  }
}

/// Its columns refer to the result of which it was made.
struct Dataset {
  struct Dimension {
    std::string name;
    std::size_t length;
  };
  /// With the attributes of every file.
  explicit Dataset(const std::string& title);

  /// Its place.
  std::size_t dimension(const std::string& name, std::size_t length);
  DataColumn& add(const std::string& name, const std::string& units, const std::string& long_name,
                  const std::vector<std::size_t>& along, const DataValues& values,
                  DataColumn::Type type = DataColumn::Type::real);
  DataColumn& add(const Column& told, const std::vector<std::size_t>& along, const DataValues& values,
                  DataColumn::Type type = DataColumn::Type::real);
  DataColumn& add_texts(const std::string& name, std::size_t along, const std::vector<std::string>& texts,
                        const std::string& long_name);
  /// A text of each of the items.
  template <class Items, class Text>
  DataColumn& add_texts(const std::string& name, std::size_t along, const Items& items, const Text& text,
                        const std::string& long_name) {
    std::vector<std::string> texts;
    for (const auto& item : items) texts.emplace_back(std::invoke(text, item));
    return add_texts(name, along, texts, long_name);
  }
  void say(const std::string& attribute, const std::string& text) { attributes.emplace_back(attribute, text); }

  std::vector<Dimension> dimensions;
  std::vector<DataColumn> columns;
  TextAttributes attributes;
  bool filled = true;  ///< places are filled before values are written
};

}  // namespace equipoise
