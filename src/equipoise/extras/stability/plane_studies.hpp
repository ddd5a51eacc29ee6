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

  /// Turns `study`, a copy of the given one or of another of this plane's, into that of these values.
  void put(double x, double y, Study& study) const;
  Study at(double x, double y) const;

  const Study& study() const { return study_; }  ///< as given
  /// Whether a study can have these values.
  bool valid(double x, double y) const;
  /// Whether values are put into their places, as study_with() would, instead of reading a study anew for each.
  bool direct() const { return direct_; }
  /// The given study's own values; none if one of them is no single number.
  std::optional<double> own_x() const { return own(x_.key); }
  std::optional<double> own_y() const { return own(y_.key); }

 private:
  Study read(double x, double y) const;
  std::optional<double> own(const std::string& key) const;

  Study study_;
  SliceAxis x_, y_;
  bool direct_ = false;
};

}  // namespace equipoise
