// Sections, dimensions and symmetries of systems.
#include "equipoise/machine/model/system.hpp"

#include <cmath>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise::model {

namespace {
Section section_of(const Parameters& p, bool prescribed) {
  if (!depends_on_rotor_angle(p)) return Section::none;
  return prescribed ? Section::stroboscopic : Section::turn;
}
}  // namespace

System::System(const Parameters& p, double speed) : System(p, DrivePiece{.prescribed = true, .speed = speed}) {}

System::System(const Parameters& p, const DrivePiece& last)
    : p_(p),
      drive_(last),
      section_(section_of(p, last.prescribed)),
      layout_(StateLayout::of(p.balls, section_ == Section::turn, last.driven(),
                              last.driven() && last.motor.integral != 0.0, p.tilts())) {}

std::optional<double> System::no_load_speed() const {
  if (prescribed()) return std::nullopt;
  const DriveSegment& m = drive_.motor;
  return m.integral != 0.0 ? std::optional(m.aim) : m.even_speed(0.0);
}

bool System::coasts() const { return !prescribed() && drive_.motor.is_idle(); }

bool System::runs_away(double speed) const {
  const bool held = prescribed() || coasts() || drive_.motor.brakes();
  return !held && std::fabs(speed) > out_of_reach;
}

double System::torque(const Eigen::VectorXd& y) const {
  if (prescribed()) return 0.0;
  return drive_.motor.motor_torque(drive_.motor.begin, speed(y), layout_.error < 0 ? 0.0 : y[layout_.error]);
}

double System::section_angle() const { return model::section_angle(p_); }

double System::section_period() const { return model::section_period(p_, drive_.speed); }

std::vector<System::Angle> System::angles() const {
  std::vector<Angle> result;
  for (int i = 0; i < p_.balls; ++i) result.push_back({index::phi(i), two_pi});
  if (layout_.psi >= 0) result.push_back({layout_.psi, section_angle()});
  return result;
}

Eigen::VectorXd System::with_angles_reduced(Eigen::VectorXd y) const {
  for (const auto& [place, turn] : angles()) y[place] -= turn * std::floor(y[place] / turn);
  return y;
}

Eigen::VectorXd state_scale(const Parameters& p) {
  Eigen::VectorXd result = Eigen::VectorXd::Ones(dimension(p.balls));
  result.head(4).setConstant(p.motion_scale());
  return result;
}

Eigen::VectorXd System::scale() const {
  Eigen::VectorXd result = Eigen::VectorXd::Ones(dimension());
  result.head(model::dimension(p_.balls)) = state_scale(p_);
  if (layout_.tilt >= 0) result.segment(layout_.tilt, 4).setConstant(p_.motion_scale());
  return result;
}

}  // namespace equipoise::model
