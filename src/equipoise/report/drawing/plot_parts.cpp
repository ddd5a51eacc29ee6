// Colours and labels of the pictures.
#include "equipoise/report/drawing/plot_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/results/commands/branch.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {

// Colours that people with any kind of colour vision can distinguish (M. Okabe, K. Ito, Color Universal Design, 2008),
// by identifier. The later ones (P. Tol, muted scheme) are for attractors without a fixed identifier.
constexpr std::array colours{"#009E73", "#0072B2", "#D55E00", "#E69F00", "#CC79A7", "#56B4E9", "#666666",
                             "#882255", "#332288", "#999933", "#44AA99", "#AA4499", "#117733", "#661100"};

// Viridis (S. van der Walt, N. Smith, 2015) in even steps from none to all.
constexpr std::array viridis{"#440154", "#472c7a", "#3b518b", "#2c718e", "#21908d",
                             "#27ad81", "#5cc863", "#aadc32", "#fde725"};

}  // namespace

const char* colour_of(int code) {
  if (code == undecided_code) return "#DDDDDD";
  if (code == diverged_code) return "#000000";
  if (code == stalled_code) return "#9A8700";
  if (code < 0) return "#F0E442";  // failed
  return colours[static_cast<std::size_t>(code - 1) % colours.size()];
}

namespace {
// With signs for what a terminal writes as words.
std::string in_signs(std::string text) {
  constexpr std::pair<std::string_view, std::string_view> signs[] = {
      {"Omega", "Ω"}, {"lambda", "λ"}, {"zeta", "ζ"}, {"kappa", "κ"}, {"mu", "μ"}, {"beta", "β"}, {"sqrt", "√"}};
  for (const auto& [word, sign] : signs)
    if (const std::size_t at = text.find(word); at != std::string::npos) text.replace(at, word.size(), sign);
  return text;
}
}  // namespace

std::string axis_label(const std::string& key) {
  if (const std::string label = parameter_label(key); label != key) return in_signs(label);
  constexpr std::string_view angle = "initial.phi_";
  if (key.starts_with(angle) && !key.starts_with("initial.phi_dot"))
    return fmt::format("initial angle of ball {0}, φ{0} (rad)", key.substr(angle.size()));
  constexpr std::string_view rate = "initial.phi_dot_";
  if (key.starts_with(rate)) return fmt::format("initial rate of ball {0}, φ{0}' / √(k/M)", key.substr(rate.size()));
  for (const std::string name : {"x", "y"}) {
    if (key == "initial." + name) return fmt::format("initial {} / race radius, rotating frame", name);
    if (key == "initial." + name + "_dot") return fmt::format("initial {}' / (race radius x √(k/M))", name);
  }
  return key;
}

std::string label_with_unit(const std::string& key, const std::string& unit) {
  return unit.empty() ? axis_label(key) : fmt::format("{} ({})", key, unit);
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
  return mixed_colour(viridis[below], viridis[below + 1], place - static_cast<double>(below));
}

std::string mixed_colour(const char* from, const char* to, double part) {
  std::string colour = "#";
  for (const std::size_t at : {1, 3, 5}) {
    const auto value = [&](const char* of) { return std::stoi(std::string(of + at, 2), nullptr, 16); };
    colour += fmt::format("{:02x}", std::lround(value(from) + part * (value(to) - value(from))));
  }
  return colour;
}

}  // namespace equipoise
