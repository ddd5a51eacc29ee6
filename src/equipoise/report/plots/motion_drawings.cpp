// A motion in two views, and in words.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/tilt_balance.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/text/quantities.hpp"

namespace equipoise {

namespace {
using study::Dimension;

constexpr SvgPoint race_centre{80.0, 84.0}, rest_place{246.0, 84.0};
constexpr double race = 60.0, field = 66.0;  // radii

// Scale of the ring around the centre's path: enough for all motions, and for a fifth of the eccentricity. Below that a
// rotor counts as balanced in any drawing.
double ring_radius(const MachinePage& page) {
  double reach = 0.2 * page.basin.study.parameters.eccentricity;
  for (const DrawnMotion& m : page.motions) reach = std::max(reach, m.r_max);
  const double unit = page.basin.study.scales ? page.basin.study.scales->length : 1.0;
  return round_up(std::max(reach, 1e-12) * unit) / unit;
}

// Radius of the ball; a clearly visible one if the study gives no size.
double ball_pixels(const model::Parameters& p, std::size_t i) {
  double radius = 0.0;
  if (p.ball_radius[i] > 0.0)
    radius = p.ball_radius[i];
  else if (p.balls_collide())
    radius = std::sin(0.5 * p.contact_angle);
  return radius > 0.0 ? std::clamp(radius * race, 4.0, 16.0) : 7.0;
}

// Races in different planes are drawn inside each other.
double race_radius(const std::vector<double>& planes, std::size_t k) {
  constexpr double inmost = 0.4;
  return race * (1.0 - (1.0 - inmost) * static_cast<double>(k) / static_cast<double>(planes.size()));
}
// The furthest to the front is the outermost.
double race_of_ball(const model::Parameters& p, std::size_t ball) {
  const std::vector<double> planes = model::planes_of(p);
  return race_radius(
      planes, static_cast<std::size_t>(planes.end() - std::find(planes.begin(), planes.end(), p.tilt.plane[ball]) - 1));
}

void draw_race(Svg& svg, const model::Parameters& p) {
  const std::vector<double> planes = model::planes_of(p);
  for (std::size_t k = 0; k < std::max<std::size_t>(planes.size(), 1); ++k)
    svg.circle(race_centre, planes.empty() ? race : race_radius(planes, k), {rule_colour, "", 5.0});
  svg.line({race_centre.x - 4.0, race_centre.y}, {race_centre.x + 4.0, race_centre.y}, {quiet_ink, ""});
  svg.line({race_centre.x, race_centre.y - 4.0}, {race_centre.x, race_centre.y + 4.0}, {quiet_ink, ""});
  if (p.tilts()) return;  // each plane has a heavy side of its own
  // The heavy side is on the right.
  const double from = race_centre.x + 0.48 * race, to = race_centre.x + 0.72 * race;
  svg.path({{to, race_centre.y}, {from, race_centre.y - 7.0}, {from, race_centre.y + 7.0}}, {"", quiet_ink}, true);
}

double place_of(const BallOnMotion& ball) { return ball.drift != 0.0 ? ball.place : 0.5 * (ball.low + ball.high); }

bool coincide(const BallOnMotion& a, const BallOnMotion& b) {
  constexpr double seen = 0.02;  // rad, a pixel on the race
  return std::fabs(wrapped(place_of(a) - place_of(b))) < seen;
}
bool coincide(const model::Parameters& p, const std::vector<BallOnMotion>& balls, std::size_t i, std::size_t k) {
  return p.tilt.plane[i] == p.tilt.plane[k] && coincide(balls[i], balls[k]);
}

void draw_balls(Svg& svg, const MachinePage& page, const DrawnMotion& motion) {
  const std::string colour = colour_of(motion.id);
  const model::Parameters& p = page.basin.study.parameters;
  const bool several = motion.balls.size() > 1;
  for (std::size_t i = 0; i < motion.balls.size(); ++i) {
    const BallOnMotion& ball = motion.balls[i];
    const double radius = race_of_ball(p, i);
    constexpr double arrow = 1.0, least_way = 0.03;
    if (ball.drift != 0.0)
      svg.arc(race_centre, radius, ball.place, ball.place + std::copysign(arrow, ball.drift), {colour, "", 3.0}, true);
    else if (ball.high - ball.low > least_way)
      svg.arc(race_centre, radius, ball.low, ball.high, {colour, "", 6.0, 0.45});
  }
  for (std::size_t i = 0; i < motion.balls.size(); ++i) {
    const double size = ball_pixels(p, i);
    const double angle = place_of(motion.balls[i]), radius = race_of_ball(p, i);
    const SvgPoint at{race_centre.x + radius * std::cos(angle), race_centre.y - radius * std::sin(angle)};
    svg.circle(at, size, {"var(--paper)", colour, 1.2});
    // Balls that travel as one carry all their numbers.
    std::string number;
    for (std::size_t k = 0; k < motion.balls.size(); ++k)
      if (k == i || coincide(p, motion.balls, i, k)) number += fmt::format("{}{}", number.empty() ? "" : "+", k + 1);
    if (several && size >= 6.0)
      svg.text({at.x, at.y + (number.size() > 1 ? 2.3 : 3.2)}, number, SvgAnchor::middle, "#ffffff",
               number.size() > 1 ? 6.5 : 9.0);
  }
}

void draw_centre(Svg& svg, const MachinePage& page, const DrawnMotion& motion) {
  const double ring = ring_radius(page);
  svg.circle(rest_place, field, {rule_colour, "", 1.0});
  const auto& limit = page.basin.study.limits.displacement;
  if (limit && *limit < ring) svg.circle(rest_place, field * *limit / ring, {limit_colour, "", 1.2, 1.0, true});
  svg.line({rest_place.x - 3.0, rest_place.y}, {rest_place.x + 3.0, rest_place.y}, {quiet_ink, "", 0.8});
  svg.line({rest_place.x, rest_place.y - 3.0}, {rest_place.x, rest_place.y + 3.0}, {quiet_ink, "", 0.8});
  std::vector<SvgPoint> way;
  double reach = 0.0;
  for (std::size_t k = 0; k < motion.x.size(); ++k) {
    way.push_back({rest_place.x + field * motion.x[k] / ring, rest_place.y - field * motion.y[k] / ring});
    reach = std::max(reach, std::hypot(motion.x[k], motion.y[k]));
  }
  constexpr double dot = 2.5;  // pixels
  if (reach / ring * field < dot)
    svg.circle(rest_place, dot, {"", colour_of(motion.id)});
  else
    svg.path(way, {colour_of(motion.id), "", 1.1});
  const PageQuantities shown(page.basin.study);
  svg.text({rest_place.x, rest_place.y + field + 14.0}, "ring: " + shown.text(ring, Dimension::length),
           SvgAnchor::middle, quiet_ink);
}

std::string motion_svg(const MachinePage& page, const DrawnMotion& motion) {
  const model::Parameters& p = page.basin.study.parameters;
  Svg svg(330.0, 170.0,
          motion.name + (p.tilts() ? ": balls in their races and the path of the shaft"
                                   : ": balls in the race and the path of the rotor's centre"));
  draw_race(svg, p);
  draw_balls(svg, page, motion);
  draw_centre(svg, page, motion);
  svg.text({race_centre.x, rest_place.y + field + 14.0}, model::planes_of(p).size() > 1 ? "races" : "race",
           SvgAnchor::middle, quiet_ink);
  return svg.str();
}

// "the balls rest in the race"; "ball 1 rests, ball 2 falls behind by 0.9 ω_c".
std::string ball_words(const PageQuantities& shown, const DrawnMotion& m) {
  constexpr double still = 0.01;  // rad: in a race of 0.1 m they move by a millimetre
  std::vector<std::string> does;
  for (const BallOnMotion& b : m.balls) {
    const bool behind = b.drift * (m.speed < 0.0 ? -1.0 : 1.0) < 0.0;
    does.push_back(b.drift != 0.0           ? fmt::format("{} by {}", behind ? "behind" : "ahead",
                                                          shown.text(std::fabs(b.drift), Dimension::speed))
                   : b.high - b.low < still ? "rest"
                                            : "swing");
  }
  const auto words = [](const std::string& what, bool one) {
    if (what == "rest") return std::string(one ? "rests in the race" : "rest in the race");
    if (what == "swing") return std::string(one ? "swings about its place" : "swing about their places");
    return (what.starts_with("behind") ? one ? "falls " : "fall " : one ? "runs " : "run ") + what;
  };
  if (std::all_of(does.begin(), does.end(), [&](const std::string& one) { return one == does.front(); }))
    return does.size() == 1 ? "the ball " + words(does[0], true) : "the balls " + words(does[0], false);
  std::string text;
  for (std::size_t i = 0; i < does.size(); ++i)
    text += fmt::format("{}ball {} {}", i ? ", " : "", i + 1, words(does[i], true));
  return text;
}

std::string motion_words(const Study& study, const DrawnMotion& m) {
  const PageQuantities shown(study);
  const bool rests = m.r_max < 1e-9;
  std::string text = rests ? "The centre rests on the axis" : "The centre is ";
  if (m.bearing)
    text = fmt::format(fmt::runtime(rests ? "At {} the shaft rests on the axis" : "At {} the shaft is "),
                       shown.text(*m.bearing, Dimension::length));
  if (!rests) text += shown.range(m.r_min, m.r_max, Dimension::length) + " off the axis";
  if (study.speed.driven()) text += fmt::format(" at {}", shown.text(m.speed, Dimension::speed));
  text += "; " + ball_words(shown, m);
  text += ".";
  if (m.one_start) text += " Drawn from the end of one start.";
  if (m.continuum) text += " One of a continuum of such motions.";
  return text;
}

}  // namespace

Drawing motion_drawing(const MachinePage& page, const DrawnMotion& motion) {
  const Study& study = page.basin.study;
  return {reader_title(motion, study.scales.has_value()), motion_svg(page, motion), motion_words(study, motion),
          colour_of(motion.id)};
}

}  // namespace equipoise
