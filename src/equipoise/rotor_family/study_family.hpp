// Studies that differ in a few values: those of an uncertain study's starts, or of a map's pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "equipoise/rotor_family/direct_values.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// The ends of so many values are tried in all combinations, of more each by itself.
inline constexpr std::size_t most_tried_together = 6;

/// A part of a family: bounds of the fractions of every value, between 0 and 1.
struct FamilyBox {
  std::vector<double> low, high;

  bool holds(std::span<const double> fractions) const;
  std::vector<double> centre() const;
  /// Where a point of the unit cube lies in it.
  std::vector<double> at(std::span<const double> of_cube) const;
};

/// Values that differ from one study to another, each a function (its quantile) of a fraction that is drawn evenly
/// between 0 and 1. Thread-safe.
class StudyFamily {
 public:
  struct Quantile {
    std::function<double(double fraction)> at;
    /// Fractions beyond which values run far away: no part of the family reaches there.
    double low = 0.0, high = 1.0;
    std::vector<double> breaks{};  ///< fractions at which the value jumps
  };
  /// Throws InputError where there is no such study. Nothing in it is uncertain, and its horizon is filled in.
  using Make = std::function<Study(std::span<const double> values)>;

  /// Of the uncertain values of `study`, whose horizon is filled in.
  explicit StudyFamily(const Study& study);
  StudyFamily(std::vector<Quantile> values, Make make);

  std::size_t size() const { return values_.size(); }
  /// All of it, cut where values jump.
  std::vector<FamilyBox> parts() const;
  Study at(std::span<const double> values) const { return direct_ ? direct_->at(values) : make_(values); }
  std::vector<double> values_at(std::span<const double> fractions) const;
  /// How far each value is on its way from one end of a box to the other: from 0 to 1 within it.
  std::vector<double> coordinates(const FamilyBox& box, std::span<const double> fractions) const;
  /// Draw `index` of a box, the same for every family of this size. Throws InputError where there is no such study.
  Study draw(const FamilyBox& box, std::uint64_t index) const;
  /// Its fractions in the box's unit cube.
  std::vector<double> place(std::uint64_t index) const;
  /// A study of a box, and its coordinates there.
  struct Placed {
    std::vector<double> coordinates;
    Study study;
  };
  /// The studies at a box's centre and then at its corners that there are; of more than most_tried_together values at
  /// the ends of each alone in place of the corners.
  std::vector<Placed> ends(const FamilyBox& box) const;

 private:
  std::vector<Quantile> values_;
  Make make_;
  std::optional<DirectValues> direct_;
};

/// The part of a study that its attractors depend on: a fixed drive counts by its last speed alone, while how a motor
/// brings its rotor up is part of what can be met, for a limited one may never pass a resonance. The horizon is filled
/// in.
Study at_final_speed(const Study& study);

}  // namespace equipoise
