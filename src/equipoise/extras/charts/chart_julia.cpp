// The script: data, then functions.
#include "equipoise/extras/charts/chart_julia.hpp"

#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

namespace {

constexpr char julia_begin[] = R"(# Points of curves in a plane of two parameters, written by equipoise {}.
#
# include(this file); problem(1) is a BifurcationProblem at the first point, along its parameter x. For example:
#
#   using BifurcationKit
#   branch = continuation(problem(1), PALC(), ContinuationPar(p_min = x_range[1], p_max = x_range[2]))
#
# It needs BifurcationKit.jl 0.4 or later, PythonCall.jl, and equipoise's Python package, which has the equations.
# states[k]: a state at rest, or one of a cycle of period 2 pi / frequency, at which rates[k] are multipliers.
using BifurcationKit
using PythonCall

const study_text = raw"""
{}"""
const keys_of_study = ("{}", "{}")
const x_range = ({}, {})
const y_range = ({}, {})
)";

constexpr char julia_end[] = R"(
const equipoise = pyimport("equipoise")
const study = equipoise.Study.from_toml(study_text)
const numpy = pyimport("numpy")

function model(p)
    changes = pydict([keys_of_study[1] => p.x, keys_of_study[2] => p.y])
    return equipoise.Model(study.replace(changes), frame = "inertial")
end
state_for_python(z) = numpy.array(pylist(Float64[v for v in z]))
rhs(z, p) = pyconvert(Vector{Float64}, model(p).rhs(0.0, state_for_python(z)))
jacobian(z, p) = pyconvert(Matrix{Float64}, model(p).jacobian(0.0, state_for_python(z)))

problem(k) = BifurcationProblem(rhs, states[k], (x = xs[k], y = ys[k]), (@optic _.x);
    J = jacobian, record_from_solution = (z, p; k...) -> hypot(z[1], z[2]))
)";

// The key of a study's file.
std::string julia_key(const Study& study, const std::string& key) {
  return key == "speed.final" && study.speed.profile == Profile::constant ? "speed.speed" : key;
}

std::string julia_number(double value) { return std::isfinite(value) ? fmt::format("{:.17g}", value) : "NaN"; }

}  // namespace

std::string chart_julia(const BifurcationChart& chart) {
  if (!chart.study.system().prescribed()) return {};
  const SliceAxis &x = chart.plane.x, &y = chart.plane.y;
  std::string text = fmt::format(julia_begin, version_string, to_toml(chart.study), julia_key(chart.study, x.key),
                                 julia_key(chart.study, y.key), julia_number(x.low), julia_number(x.high),
                                 julia_number(y.low), julia_number(y.high));
  std::string kinds, curves, xs, ys, frequencies, states, rates;
  for (std::size_t k = 0; k < chart.curves.size(); ++k)
    for (const CurvePoint& p : chart.curves[k].points) {
      if (p.state.empty()) continue;
      kinds += fmt::format("\"{}\",\n", curve_kind_names[static_cast<std::size_t>(chart.curves[k].kind)]);
      curves += fmt::format("{},\n", k + 1);
      xs += julia_number(p.x) + ",\n";
      ys += julia_number(p.y) + ",\n";
      frequencies += julia_number(p.frequency) + ",\n";
      states += "[";
      for (const double value : p.state) states += julia_number(value) + ", ";
      states += "],\n";
      rates += "ComplexF64[";
      for (const auto& rate : p.rates)
        rates += fmt::format("complex({}, {}), ", julia_number(rate.real()), julia_number(rate.imag()));
      rates += "],\n";
    }
  for (const auto& [name, type, values] : {std::tuple{"kinds", "String", &kinds},
                                           {"curves", "Int", &curves},
                                           {"xs", "Float64", &xs},
                                           {"ys", "Float64", &ys},
                                           {"frequencies", "Float64", &frequencies},
                                           {"states", "Vector{Float64}", &states},
                                           {"rates", "Vector{ComplexF64}", &rates}})
    text += fmt::format("const {} = {}[\n{}]\n", name, type, *values);
  return text + julia_end;
}

}  // namespace equipoise
