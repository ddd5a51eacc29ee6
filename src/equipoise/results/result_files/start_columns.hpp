// What is kept of every start: one column of values each, the same in unfinished and in finished files.
#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/commands/start_arrays.hpp"

namespace equipoise {

struct BasinFileHeader;

namespace io {

/// Marks a figure that a start does not have: what NetCDF itself fills with.
inline constexpr float missing_figure = 9.9692099683868690e+36f;

struct StartColumn : StoredColumn {
  /// A member of StartArrays, or the place of a transient figure.
  std::variant<std::vector<double> StartArrays::*, std::vector<float> StartArrays::*, std::vector<short> StartArrays::*,
               std::vector<signed char> StartArrays::*, std::size_t>
      values;

  bool is_figure() const { return std::holds_alternative<std::size_t>(values); }
  /// Calls use(its values in `arrays`), `width` per start.
  template <class Arrays, class Visit>
  void visit(Arrays& arrays, const Visit& use) const {
    std::visit(
        [&]<class Place>(Place place) {
          if constexpr (std::is_same_v<Place, std::size_t>)
            use(arrays.transients[place]);
          else
            use(arrays.*place);
        },
        values);
  }
  /// As a file has it, at a place among them.
  double stored(const StartArrays& starts, std::size_t place) const;
  /// Puts values from a file in `starts`, of a figure after the peak's. A start that was lost has no figures; a
  /// settling time without an end, or a time above a limit, is infinite.
  void take(const std::vector<double>& from_file, StartArrays& starts) const;
};

/// The columns of a file, in order. To keep something more of every start, add it to StartArrays and there.
std::vector<StartColumn> start_columns(const BasinFileHeader& header);
/// Those of all files together.
std::vector<StartColumn> start_columns();

}  // namespace io
}  // namespace equipoise
