// Values that are themselves parameters of a study: studies that differ only in these need not be read anew.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

class DirectValues {
 public:
  /// Compares the studies that `make` returns for some values with the first of them, its parameters replaced. Empty if
  /// they differ in anything else.
  static std::optional<DirectValues> of(const std::function<Study(std::span<const double>)>& make,
                                        const std::vector<std::vector<double>>& some);

  Study at(std::span<const double> values) const;

 private:
  Study base_;
  std::vector<std::vector<std::size_t>> places_;  // where each value goes, in the order of numbers_of()
};

}  // namespace equipoise
