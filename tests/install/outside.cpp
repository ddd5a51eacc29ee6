// Somebody else's program: everything that docs/reference/cpp.md shows, with the installed headers, and checks of its
// results.
#include <cmath>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include <equipoise/equipoise.hpp>

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  if (!holds) std::printf("does not hold: %s\n", what);
  failures += !holds;
}

equipoise::Study filled_in_by_code() {
  equipoise::Study study;
  study.name = "outside";
  study.parameters.mass = {0.05, 0.05};
  study.parameters.drag = {0.05, 0.05};
  study.speed.profile = equipoise::Profile::constant;
  study.speed.speed = 2.6;
  study.sampling.starts = 2000;
  study.initial.phi = {1.0, 4.0};
  return study;
}

// A study from a tree of values and back; errors in parts.
void trees() {
  using equipoise::StudyValue;
  StudyValue tree{{"rotor", {{"eccentricity", 0.01}, {"damping", 0.5}}},
                  {"balancer", {{"balls", 2}, {"mass", 0.05}, {"drag", 0.05}}},
                  {"speed", {{"profile", "constant"}, {"speed", 2.4}}},
                  {"initial", {{"phi", std::vector{1.0, 4.0}}}}};
  const equipoise::Study study = equipoise::study_from(tree, "my study", {"speed.speed=2.6"});
  expect(study.speed.speed == 2.6 && study.initial.phi[1] == 4.0, "a study is read from a tree, with overrides");
  const StudyValue back = equipoise::to_tree(study);
  expect(back.find("balancer")->find("mass")->array()->at(1).number() == 0.05, "a study is a tree again");
  tree.find("rotor")->set("damping", -0.5);
  try {
    equipoise::study_from(tree, "my study");
    expect(false, "bad values are refused");
  } catch (const equipoise::InputError& e) {
    expect(e.place().name == "my study" && e.place().line == 0 && e.key() == "rotor.damping" && e.value() == "-0.5" &&
               e.wrong().empty() && e.allowed() == "a finite number at least 0",
           "an error tells place, key, value and what is allowed");
  }
  try {
    equipoise::parse_study("[rotor]\neccentricity = -1\n", "my.toml");
    expect(false, "bad values are refused");
  } catch (const equipoise::InputError& e) {
    expect(e.place().name == "my.toml" && e.place().line == 2, "an error of a text tells the line");
  }
  equipoise::Study wrong = study;
  wrong.parameters.drag[1] = -1.0;
  try {
    equipoise::check(wrong);
    expect(false, "what code fills in is checked");
  } catch (const equipoise::InputError& e) {
    expect(e.key() == "balancer.drag", "what code fills in is checked by the same rules");
  }
}

// Progress and stop on this thread, starts in arrays, one start.
void ensembles(const equipoise::Study& study) {
  equipoise::BasinOptions options;
  options.threads = 1;
  options.keep_starts = true;
  options.cpu_target = equipoise::cpu_targets().front();
  bool here = true;
  options.progress = [&, caller = std::this_thread::get_id()](const equipoise::Progress& p) {
    here = here && std::this_thread::get_id() == caller;
    here = here && (p.preparing || (p.done <= p.total && p.balanced.has_value() == (p.done > 0)));
  };
  const equipoise::BasinResult answer = equipoise::basin(study, options);
  const equipoise::Share& balanced = answer.attractors.front().share;
  std::printf("balanced %.4f [%.4f, %.4f] on %s\n", balanced.share, balanced.low, balanced.high,
              answer.cpu_target.c_str());
  // The published share is 99.59 %; 2000 starts give it with a standard error of 0.14 %.
  expect(balanced.share > 0.985 && balanced.share < 1.0, "the published share");
  expect(here, "progress is reported on the caller's thread");
  const equipoise::StartArrays& starts = *answer.every_start;
  std::uint64_t ones = 0;
  for (const short code : starts.outcome) ones += code == answer.attractors.front().id;
  expect(starts.starts == 2000 && ones == balanced.count, "every start is kept");
  expect(equipoise::start_of(study, 7).phi[1] == starts.phi[15], "a start is found by its index");

  equipoise::BasinOptions endless;
  endless.half_width = 1e-5;
  endless.stop_asked = [] { return true; };
  expect(equipoise::basin(study, endless).partial, "work stops when it is asked to");
}

// One's own starts and integrators.
void own_methods(const equipoise::Study& study) {
  equipoise::BasinOptions options;
  options.keep_starts = true;
  for (std::uint64_t i = 0; i < 50; ++i) options.initial.push_back(equipoise::start_of(study, i));
  const equipoise::BasinResult answer = equipoise::basin(study, options);
  const equipoise::Mapper mapper(study);
  const std::vector<equipoise::Outcome> outcomes = mapper(options.initial);
  expect(answer.starts == 50 && outcomes[7].time == answer.every_start->decision_time[7],
         "starts of one's own are decided");
  expect(mapper.name(mapper(options.initial[7])) == mapper.name(outcomes[7]), "a state is told by name");
  equipoise::write_basin_file("outside.nc", answer);
  expect(equipoise::inspect_file("outside.nc").kind == "basin", "an ensemble is written down from memory");
  std::remove("outside.nc");

  const equipoise::StudyEquations equations(study);
  std::vector<double> y = equations.initial_state(), dy(y.size());
  constexpr double step = 1e-3;  // Euler's error: the step times a second derivative of the order of one
  for (int k = 0; k < 100; ++k) {
    equations.rhs(k * step, y.data(), dy.data());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += step * dy[i];
  }
  const auto there = equipoise::simulate(study, {100 * step});
  expect(std::fabs(equations.motion(0.1, y.data()).phi[1] - there.phi[1][0]) < step, "an integrator of one's own");
}

void motions(const equipoise::Study& study) {
  equipoise::AttractorsOptions search;
  search.starts = 500;
  const auto known = equipoise::attractors(study, search);
  for (const equipoise::Attractor& a : known.attractors)
    std::printf("%d %s, r up to %.4f\n", a.id, a.name.c_str(), a.motion.r_max);
  expect(known.attractors.size() >= 2, "there are attractors besides balance");

  const equipoise::ParameterLine line(study, "speed.final=2.6:2.65:0.05");
  equipoise::ContinuationOptions following;
  int reports = 0;
  following.progress = [&](const equipoise::Progress&) { ++reports; };
  const equipoise::BranchesResult branches = equipoise::follow_attractors(study, line, following);
  expect(reports >= 2 && branches.branches.size() >= 2 && branches.branches.front().points.size() == 2,
         "attractors are followed along a parameter");
  std::printf("%s", equipoise::result_text(branches).c_str());

  const equipoise::StopFlag stop{true};
  equipoise::RunOptions stopped;
  stopped.stop = &stop;
  expect(equipoise::certify(study).proved() && equipoise::certify(study, stopped).partial,
         "proofs, and none if stopped");
}

void trajectories(const equipoise::Study& study) {
  const auto trajectory = equipoise::simulate(study, equipoise::output_times(study, 400.0));
  std::printf("r(%g) = %.3g\n", trajectory.t.back(), trajectory.radial.back());
  expect(trajectory.t.size() == 101 && trajectory.radial.back() < 1e-3, "one trajectory comes to balance");
  equipoise::BasinSliceSettings plane;
  plane.x = {"rotor.eccentricity", 0.0, 0.02, 2};
  plane.y = {"initial.phi_1", 0.0, 6.0, 2};
  expect(equipoise::basin_slice(study, plane).code.size() == 4, "a map of four pixels");
}

}  // namespace

int main() {
  const equipoise::Study study = filled_in_by_code();
  trees();
  ensembles(study);
  own_methods(study);
  motions(study);
  trajectories(study);
  return failures;
}
