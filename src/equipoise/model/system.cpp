// Sections, dimensions and symmetries of systems.
#include "equipoise/model/system.hpp"

#include "equipoise/base/angles.hpp"
#include "equipoise/model/strobe.hpp"

namespace equipoise::model {

namespace {
Section section_of(const Parameters& p, bool prescribed) {
  if (!is_strobed(p)) return Section::none;
  return prescribed ? Section::strobe : Section::turn;
}
}  // namespace

System::System(const Parameters& p, double speed) : System(p, DrivePiece{.prescribed = true, .speed = speed}) {}

System::System(const Parameters& p, const DrivePiece& last)
    : p_(p), drive_(last), section_(section_of(p, last.prescribed)), dimension_(model::dimension(p.balls)) {
  if (!last.prescribed) dimension_ += 1 + (section_ == Section::turn ? 1 : 0) + (has_error_integral() ? 1 : 0);
}

double System::strobe_angle() const { return model::strobe_angle(p_); }

double System::strobe_period() const { return model::strobe_period(p_, drive_.speed); }

std::vector<System::Angle> System::angles() const {
  std::vector<Angle> result;
  for (int i = 0; i < p_.balls; ++i) result.push_back({index::phi(i), two_pi});
  if (psi_place() >= 0) result.push_back({psi_place(), strobe_angle()});
  return result;
}

Eigen::VectorXd state_scale(const Parameters& p) {
  Eigen::VectorXd result = Eigen::VectorXd::Ones(dimension(p.balls));
  result.head(4).setConstant(p.all_unbalances());
  return result;
}

Eigen::VectorXd System::scale() const {
  Eigen::VectorXd result = Eigen::VectorXd::Ones(dimension_);
  result.head(model::dimension(p_.balls)) = state_scale(p_);
  return result;
}

}  // namespace equipoise::model
