// Colours, labels and canvas of the pictures.
#include "equipoise/drawing/plot_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "equipoise/base/display_text.hpp"
#include "equipoise/base/plural.hpp"
#include "equipoise/types/fate.hpp"
#include "equipoise/words/plots.hpp"

namespace equipoise {

namespace {

// Colours that people with any kind of colour vision can tell apart (M. Okabe, K. Ito, Color Universal Design, 2008),
// by identifier. The later ones (P. Tol, muted scheme) are for attractors without a fixed identifier.
constexpr std::array colours{"#009E73", "#0072B2", "#D55E00", "#E69F00", "#CC79A7", "#56B4E9", "#666666",
                             "#882255", "#332288", "#999933", "#44AA99", "#AA4499", "#117733", "#661100"};

}  // namespace

const char* colour_of(int code) {
  if (code == undecided_code) return "#DDDDDD";
  if (code == diverged_code) return "#000000";
  if (code == stalled_code) return "#9A8700";
  if (code < 0) return "#F0E442";  // failed
  return colours[static_cast<std::size_t>(code - 1) % colours.size()];
}

// On one line: what follows a line break would be a command.
std::string quoted(const std::string& text) {
  std::string result = "'";  // gnuplot does not interpret single-quoted text; quotes inside are doubled
  for (const char c : display_text(text)) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string axis_label(const std::string& key) {
  if (key == "speed.final" || key == "speed.speed") return words::plots::final_speed;
  if (key == "rotor.eccentricity") return words::plots::eccentricity;
  if (key == "rotor.damping") return words::plots::damping;
  if (key == "rotor.stiffness") return words::plots::stiffness;
  if (key == "balancer.mass") return words::plots::ball_mass;
  if (key == "balancer.drag") return words::plots::ball_drag;
  constexpr std::string_view angle = "initial.phi_";
  if (key.starts_with(angle) && !key.starts_with("initial.phi_dot"))
    return fmt::format(words::plots::initial_angle, key.substr(angle.size()));
  constexpr std::string_view rate = "initial.phi_dot_";
  if (key.starts_with(rate)) return fmt::format(words::plots::initial_rate, key.substr(rate.size()));
  for (const std::string name : {"x", "y"}) {
    if (key == "initial." + name) return fmt::format(words::plots::initial_place, name);
    if (key == "initial." + name + "_dot") return fmt::format(words::plots::initial_velocity, name);
  }
  return key;
}

std::string parameters_text(const Study& study, const std::vector<std::string>& varied) {
  const model::Parameters& p = study.parameters;
  const auto fixed = [&](const std::string& key) {
    return std::find(varied.begin(), varied.end(), key) == varied.end();
  };
  std::string text = fmt::format("{} ball{}", p.balls, plural(p.balls));
  if (fixed("balancer.mass") && p.equal_balls()) text += fmt::format(", μ = {:.4g}", p.mass[0]);
  if (fixed("balancer.drag") && p.equal_balls()) text += fmt::format(", β = {:.4g}", p.drag[0]);
  if (fixed("rotor.eccentricity")) text += fmt::format(", λ = {:.4g}", p.eccentricity);
  if (fixed("rotor.damping")) text += fmt::format(", ζ = {:.4g}", p.damping[0]);
  const bool speed_varies =
      std::any_of(varied.begin(), varied.end(), [](const std::string& key) { return key.starts_with("speed."); });
  if (!speed_varies) text += fmt::format(", Ω = {:.4g}", study.speed_profile().final_speed());
  return text;
}

std::string heat_colour(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(viridis.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  std::string colour = "#";
  for (const std::size_t at : {1, 3, 5}) {
    const auto part = [&](const char* of) { return std::stoi(std::string(of + at, 2), nullptr, 16); };
    const double from = part(viridis[below]), to = part(viridis[below + 1]);
    colour += fmt::format("{:02x}", std::lround(from + (place - static_cast<double>(below)) * (to - from)));
  }
  return colour;
}

std::string canvas(const std::string& path, int width, int height) {
  const std::string size = fmt::format("{},{}", width, height);
  const std::string terminal =
      path.ends_with(".svg")
          ? fmt::format("svg size {} font 'Helvetica,22' linewidth 1.3 background '#ffffff' noenhanced", size)
          : fmt::format("pngcairo size {} font 'DejaVu Sans,17' linewidth 1.5 noenhanced", size);
  return fmt::format("set encoding utf8\nset terminal {}\nset output {}\n", terminal, quoted(path));
}

const char* const quiet_frame =
    "set border 3 linecolor rgb '#444444'\nset tics nomirror out textcolor rgb '#222222'\n"
    "set grid linecolor rgb '#dddddd' linewidth 0.6\n";

}  // namespace equipoise
