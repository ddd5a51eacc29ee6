// What an engineer would change first, each as a study.
#include "equipoise/report/decision/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/study/contents/below_resonance.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

class Changes {
 public:
  explicit Changes(const Study& study) : study_(study), p_(study.parameters) {}

  std::vector<Change> all() {
    drag(2.0, "twice the drag");
    drag(0.5, "half the drag");
    if (p_.equal_balls()) {
      balls(p_.balls + 2);
      size(1.25);
      if (p_.balls > 2) balls(p_.balls - 1);
      size(0.8);
    }
    latch();
    faster();
    return std::move(changes_);
  }

 private:
  void add(std::string words, Study changed) {
    try {
      check(changed);
    } catch (const InputError&) {
      return;
    }
    changed.sampling.starts = starts_of_a_change;
    changed.sampling.method = std::nullopt;
    changes_.push_back({std::move(words), std::move(changed)});
  }

  void drag(double factor, const char* words) {
    Study s = study_;
    for (double& beta : s.parameters.drag) beta *= factor;
    add(words, std::move(s));
  }

  void balls(int count) {
    if (count > model::max_balls) return;
    Study s = study_;
    model::Parameters& p = s.parameters;
    for (auto* of_balls : {&p.mass, &p.drag, &p.rolling, &p.stiction, &p.ball_radius, &p.tilt.plane})
      for (int i = p.balls; i < count; ++i) (*of_balls)[static_cast<std::size_t>(i)] = of_balls->front();
    for (auto* of_balls : {&p.mass, &p.drag, &p.rolling, &p.stiction, &p.ball_radius, &p.tilt.plane})
      for (std::size_t i = static_cast<std::size_t>(count); i < of_balls->size(); ++i) (*of_balls)[i] = 0.0;
    p.balls = count;
    s.initial.phi = even_angles(count);
    s.initial.phi_dot.fill(0.0);
    s.angles_stated = false;
    add(fmt::format("{} balls", count), std::move(s));
  }

  // Drag in oil grows with the diameter (Stokes), over the mass of a ball in beta.
  void size(double factor) {
    Study s = study_;
    model::Parameters& p = s.parameters;
    std::string words =
        factor > 1.0 ? "larger balls, a quarter more in diameter" : "smaller balls, a fifth less in diameter";
    if (p.rolls && study_.scales) {
      const double diameter = 2000.0 * p.ball_radius[0] * study_.scales->length,
                   rounded = std::round(diameter * factor);
      if (!(rounded > 0.0) || rounded == diameter) return;
      factor = rounded / diameter;
      words = fmt::format("balls of {:.0f} mm", rounded);
    }
    for (double& mass : p.mass) mass *= factor * factor * factor;
    for (double& beta : p.drag) beta /= factor * factor;
    for (double& radius : p.ball_radius) radius *= factor;
    if (p.contact_angle != 0.0)
      p.contact_angle = 2.0 * std::asin(std::min(1.0, factor * std::sin(0.5 * p.contact_angle)));
    add(std::move(words), std::move(s));
  }

  // Halfway between the speed from which supports isolate and the last one.
  void latch() {
    const double last = std::fabs(study_.speed_profile().final_speed());
    const bool constant = study_.speed.profile == Profile::constant;
    if (study_.release.speed || constant || last < 1.1 * std::sqrt(2.0)) return;
    if (p_.tilts() && study_.speed.driven()) return;  // whose held balls are not followed
    Study s = study_;
    // To two digits, as it is shown: no one sets a latch to 750.99 rpm.
    const double unit = unit_of(study_, study::Dimension::speed).size;
    const double shown = 0.5 * (std::sqrt(2.0) + last) * unit,
                 step = std::pow(10.0, std::floor(std::log10(shown)) - 1.0);
    const double speed = std::copysign(std::round(shown / step) * step / unit, study_.speed_profile().final_speed());
    s.release = {};
    s.release.speed = speed;
    s.initial.phi_dot.fill(0.0);
    s.sampling.box = {};
    add(fmt::format("a latch that holds the balls until {}",
                    engineering(study_.scales, std::fabs(speed), study::Dimension::speed)),
        std::move(s));
  }

  void faster() {
    if (study_.speed.profile != Profile::ramp) return;
    Study s = study_;
    s.speed.duration *= 0.5;
    add("a run-up of half the time", std::move(s));
  }

  const Study& study_;
  const model::Parameters& p_;
  std::vector<Change> changes_;
};

}  // namespace

std::vector<Change> usual_changes(const Study& study) {
  if (!study.uncertain.empty() || study.parameters.balls == 0 || runs_below_resonance(study)) return {};
  return Changes(study).all();
}

}  // namespace equipoise
