// What is kept of every start: one column of values each, the same in unfinished and in finished files.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

struct BasinFileHeader;

/// Consecutive starts, as they come from a run. Every array has `count` entries or, where stated, so many per start.
struct StartBatch {
  std::size_t count = 0;
  const double* phi = nullptr;  ///< initial ball angles, one per ball
  const Fate* fates = nullptr;
  const double* rotor = nullptr;    ///< with full_starts: x, y, x_dot, y_dot
  const double* phi_dot = nullptr;  ///< with full_starts: one per ball
  const double* psi = nullptr;      ///< of the caller's own starts
  const double* weight = nullptr;   ///< on a grid
  const TransientRow* rows = nullptr;
  const double* drawn = nullptr;  ///< with uncertain values: one each
};

namespace io {

struct StartColumn : Column {
  DataColumn::Type type = DataColumn::Type::real;
  std::size_t value = 8;  ///< bytes of one
  /// Puts the batch's values behind `bytes`.
  std::function<void(std::vector<char>& bytes, const StartBatch&)> put;
  std::size_t width = 1;  ///< values a start
  std::string along{};    ///< the dimension along which they stand; empty for a single one
  std::size_t bytes() const { return value * width; }
};

/// The columns of a file, in order. To keep something more of every start, add it there and in what reads it.
std::vector<StartColumn> start_columns(const BasinFileHeader& header);

/// The batch column by column, as an unfinished file holds it.
std::vector<char> pack(const std::vector<StartColumn>& columns, const StartBatch& batch);

/// The fate that a code stands for. False if the code is unknown.
bool fate_from(short code, signed char by, double time, Fate& fate);

/// Marks a transient figure that a start does not have.
extern const float missing_figure;

}  // namespace io
}  // namespace equipoise
