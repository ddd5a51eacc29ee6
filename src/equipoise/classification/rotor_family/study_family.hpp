// Studies that differ in a few values: those of an uncertain study's starts, or of a basin slice's pixels.
// This room: studies that differ in a few values, starts drawn from them, and how motions vary over them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Up to this many values have their ends tried in all combinations; with more, each is tried by itself.
inline constexpr std::size_t most_tried_together = 6;

/// A part of a family: bounds on every value's fraction, within 0 to 1.
struct FamilyBox {
  std::vector<double> low, high;

  bool holds(std::span<const double> fractions) const;
  std::vector<double> centre() const;
  /// The fractions of a point of the unit cube.
  std::vector<double> at(std::span<const double> of_cube) const;
};

/// Values that differ from study to study. Each is a function (its quantile) of a fraction that is drawn evenly from 0
/// to 1. Thread-safe.
class StudyFamily {
 public:
  struct Quantile {
    std::function<double(double fraction)> at;
    /// Fractions outside have far-off values, and belong to no part of the family.
    double low = 0.0, high = 1.0;
    std::vector<double> breaks{};
  };
  /// Throws InputError if these values make no study. The study has no uncertain values, and has its horizon.
  using Make = std::function<Study(std::span<const double> values)>;

  /// From the uncertain values of `study`, which must have its horizon.
  explicit StudyFamily(const Study& study);
  StudyFamily(std::vector<Quantile> values, Make make) : values_(std::move(values)), make_(std::move(make)) {}

  std::size_t size() const { return values_.size(); }
  /// The whole family, cut where values jump.
  std::vector<FamilyBox> parts() const;
  Study at(std::span<const double> values) const { return make_(values); }
  std::vector<double> values_at(std::span<const double> fractions) const;
  /// How far each value has gone from one end of a box to the other; 0 to 1 within the box.
  std::vector<double> coordinates(const FamilyBox& box, std::span<const double> fractions) const;
  /// Draw `index` of a box, the same for all families of this size. Throws InputError if it makes no study.
  Study draw(const FamilyBox& box, std::uint64_t index) const;
  /// The draw's fractions in the box's unit cube.
  std::vector<double> place(std::uint64_t index) const;
  struct Placed {
    std::vector<double> coordinates;
    Study study;
  };
  /// The studies at a box's centre and then at its corners, if they exist. With more than most_tried_together values,
  /// at the ends of each value by itself instead of corners.
  std::vector<Placed> ends(const FamilyBox& box) const;

 private:
  std::vector<Quantile> values_;
  Make make_;
};

/// The part of a study that its attractors depend on, with its horizon filled in. For a prescribed speed only the final
/// one counts. For a motor the whole drive counts, for a weak one may never pass a resonance.
Study at_final_speed(const Study& study);

}  // namespace equipoise
