// Values that stand among a study's parameters as they are: studies that differ in these alone need no reading.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "equipoise/study/study.hpp"

namespace equipoise {

class DirectValues {
 public:
  /// Compares the studies that `make` makes of some values with the first of them, its parameters replaced. Empty if
  /// they differ in anything else.
  static std::optional<DirectValues> of(const std::function<Study(std::span<const double>)>& make,
                                        const std::vector<std::vector<double>>& some);

  Study at(std::span<const double> values) const;

 private:
  Study base_;
  std::vector<std::vector<std::size_t>> places_;  // of each value, by the order of numbers_of()
};

}  // namespace equipoise
