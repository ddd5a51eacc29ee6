// The studies of a plane: one study with other values of two numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

inline constexpr std::uint64_t most_stability_points = std::uint64_t{1} << 24;

class PlaneStudies {
 public:
  /// Throws InputError for keys that are no numbers of rotor, balancer or speed, and for values that make no valid
  /// study, looked for at the corners; so for what `check` throws of the study there.
  PlaneStudies(const Study& study, const SliceAxis& x, const SliceAxis& y,
               const std::function<void(const Study&)>& check = {});

  /// Unchecked if both keys are numbers of the study: a derivative at the end of a range looks beyond it.
  Study at(double x, double y) const;

  const Study& study() const { return study_; }  ///< as given
  const SliceAxis& x() const { return x_; }
  const SliceAxis& y() const { return y_; }
  /// Whether a study can have these values.
  bool valid(double x, double y) const;
  /// The given study's own values; none if one of them is no single number.
  std::optional<double> own_x() const { return own(x_.key); }
  std::optional<double> own_y() const { return own(y_.key); }

 private:
  Study read(double x, double y) const;
  std::optional<double> own(const std::string& key) const;

  Study study_;
  SliceAxis x_, y_;
};

}  // namespace equipoise
