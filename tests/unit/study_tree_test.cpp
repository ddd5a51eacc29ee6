// Studies as trees of values: read, written, checked, and refused with errors that have separate parts.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/toml/overrides.hpp"
#include "../support/studies.hpp"
#include "../support/refusals.hpp"
#include "../support/study_difference.hpp"

namespace equipoise {
namespace study_tree_test {

StudyValue good_tree() {
  return {{"rotor", {{"eccentricity", 0.01}, {"damping", 0.5}}},
          {"balancer", {{"balls", 2}, {"mass", std::vector{0.05, 0.06}}, {"drag", 0.05}}},
          {"speed", {{"profile", "ramp"}, {"final", 2.4}, {"duration", 500}}},
          {"release", {{"speed", 2.2}}},
          {"sampling", {{"starts", 1000}}}};
}

const std::string same_as_text =
    with(ramp_speed, "mass = 0.05", "mass = [0.05, 0.06]") + "[release]\nspeed = 2.2\n[sampling]\nstarts = 1000\n";

TEST(StudyTree, ReadsAsTheSameTextDoes) {
  StudyValue tree = good_tree();
  tree.find("release")->erase("speed");
  tree.find("release")->set("time", 0.0);
  tree.find("sampling")->set("box", {{"x", std::vector{-0.1, 0.1}}});
  const Study from_text = parse_study(same_as_text, "text", {"release={time = 0.0}", "sampling.box={x = [-0.1, 0.1]}"});
  const Study from_tree = study_from(tree, "tree");
  EXPECT_EQ(from_tree.name, "tree");
  EXPECT_EQ(first_difference(from_tree, from_text), "");
  EXPECT_EQ(from_tree.sampling.box.x->high, 0.1);
}

TEST(StudyTree, TakesOverrides) {
  const StudyValue tree = good_tree();
  const Study study = study_from(tree, "tree", {"speed.final=2.6", "speed.law=published", "limits.force=0.5"});
  EXPECT_EQ(study.speed.final, 2.6);
  EXPECT_EQ(study.speed.law, model::SpeedLaw::published);
  EXPECT_EQ(study.limits.force, 0.5);
  const InputError error = refused([&] { study_from(tree, "tree", {"speed.final=fast"}); });
  EXPECT_EQ(error.place().name, overrides_name);
  EXPECT_EQ(error.value(), "\"fast\"");
}

TEST(StudyTree, IsReadInPhysicalUnitsToo) {
  const StudyValue tree{
      {"rotor", {{"mass", "12 kg"}, {"stiffness", "48 kN/m"}, {"damping_ratio", 0.25}, {"eccentricity", "0.3 mm"}}},
      {"balancer",
       {{"balls", 2}, {"race_radius", "30 mm"}, {"mass", "600 g"}, {"drag", "1e-3 N m s"}, {"ball_diameter", "9 mm"}}},
      {"speed", {{"profile", "constant"}, {"speed", "1450 rpm"}}}};
  const Study study = study_from(tree);
  ASSERT_TRUE(study.scales);
  EXPECT_EQ(study.scales->mass, 12.0);
  EXPECT_DOUBLE_EQ(study.parameters.eccentricity, 0.01);
  ASSERT_EQ(study.ball_diameters().size(), 2u);
  EXPECT_DOUBLE_EQ(study.ball_diameters()[1], 0.009);
}

TEST(StudyTree, LeadsBackToTheSameStudy) {
  for (const auto& overrides : std::vector<std::vector<std::string>>{
           {},
           {"balancer.rolling=0.001", "balancer.stiction=[0.002, 0.003]", "balancer.race_offset=[0.001, -0.002]"},
           {"balancer.rolls=true"},
           {"balancer.rolls=true", "balancer.ball_radius=[0.1, 0.2]"},
           {"balancer.contact_angle=0.2", "balancer.restitution=0.5", "limits={displacement = 0.1, settled = 0.01}"},
           {"rotor.inertia=0.5", "speed={profile='torque'}", "release={time = 0.0}",
            "speed.torque={gain=0.1, integral=0.2, limit=3.0, target={profile='trapezoid', peak=3.0, final=2.0, "
            "rise_until=10.0, hold_until=20.0, fall_until=30.0}}"},
           {"rotor.inertia=0.5", "speed={profile='torque', stalled_below=1.0}", "release={time = 0.0}",
            "speed.torque={stall=0.2, no_load_speed=3.0}"},
           {"speed={profile='points', times=[0.0, 5.0], speeds=[1.0, 2.2]}", "release.speed=2.2",
            "numerics={tolerance=1e-8, horizon=500.0, decide='proof'}", "sampling.method=sobol"}}) {
    const Study study = parse_study(same_as_text, "study", overrides);
    EXPECT_EQ(first_difference(study_from(to_tree(study)), study), "");
    EXPECT_EQ(to_toml(study_from(to_tree(study))), to_toml(study));
  }
}

TEST(StudyTree, ErrorsNameKeyAndValueButNoLine) {
  const auto reject = [](const char* table, const char* key, StudyValue value) {
    StudyValue tree = good_tree();
    tree.find(table)->set(key, std::move(value));
    return refused([&] { study_from(tree, "my study"); });
  };
  const InputError low = reject("rotor", "damping", -0.5);
  EXPECT_STREQ(low.what(), "my study: rotor.damping = -0.5: must be a finite number at least 0");
  EXPECT_EQ(low.place().line, 0);
  EXPECT_EQ(reject("rotor", "damping", true).problem(), "is a boolean; must be a finite number at least 0");
  EXPECT_EQ(reject("rotor", "damping", StudyValue::Other{"null", "null"}).wrong(), "is null");
  EXPECT_EQ(reject("rotor", "damping", std::vector{0.1, 0.2, 0.3}).value(), "[0.1, 0.2, 0.3]");
  EXPECT_EQ(reject("rotor", "dampng", 1).wrong(), "unknown key; did you mean \"damping\"?");
  EXPECT_EQ(
      reject("sampling", "starts", std::numeric_limits<std::uint64_t>::max()).what(),
      std::string("my study: sampling.starts = 18446744073709551615: is too large a number; must be a whole number "
                  "from 1 to 1000000000000"));
  EXPECT_EQ(refused([] { study_from(StudyValue("text"), "s"); }).wrong(), "");
  EXPECT_EQ(refused([] { study_from({{"rotor", 3}}, "s"); }).key(), "rotor");
}

TEST(StudyTree, OfEqualKeysTheLastOneHolds) {
  const StudyValue table{{"a", 1}, {"b", 2}, {"a", 3}};
  ASSERT_EQ(table.table()->size(), 2u);
  EXPECT_EQ(*table.find("a")->integer(), 3);
  EXPECT_EQ(table.find("c"), nullptr);
  EXPECT_THROW(StudyValue(1.0).set("a", 1), std::logic_error);
}

TEST(InputErrors, TellFileLineKeyValueAndRangeApart) {
  const InputError error = refused([] { parse_study("[rotor]\neccentricity = -1\n", "dir/f.toml"); });
  EXPECT_STREQ(error.what(), "dir/f.toml:2: rotor.eccentricity = -1: must be a finite number at least 0");
  EXPECT_EQ(error.place().name, "dir/f.toml");
  EXPECT_EQ(error.place().line, 2);
  EXPECT_EQ(error.where(), "dir/f.toml:2");
  EXPECT_EQ(error.wrong(), "");
  EXPECT_EQ(error.allowed(), "a finite number at least 0");
  const InputError syntax = refused([] { parse_study("[rotor]\n x = = 1\n", "f:1"); });
  EXPECT_EQ(syntax.place().name, "f:1");  // a colon and a number in the name belong to the name
  EXPECT_EQ(syntax.place().line, 2);
  EXPECT_GT(syntax.place().column, 0);
  EXPECT_EQ(syntax.allowed(), "");
  const InputError entries("f", "k", "[1]", "has 1 entries; must be two finite numbers, [x, y]");
  EXPECT_EQ(entries.wrong(), "has 1 entries");
  EXPECT_EQ(entries.allowed(), "two finite numbers, [x, y]");
  const InputError unknown("f", "k", "1", "unknown key (allowed: a, b)");
  EXPECT_EQ(unknown.wrong(), "unknown key");
  EXPECT_EQ(unknown.allowed(), "a, b");
  const InputError have("f", "k", "1", "has 2 entries; must have one per time, 3");
  EXPECT_EQ(have.allowed(), "must have one per time, 3");
}

// Studies filled in by code -------------------------------------------------------------------------------------------

Study good_study() {
  Study study = parse_study(same_as_text, "code");
  study.release = {};
  return study;
}

TEST(Check, RefusesWhatNoTextCouldSay) {
  const auto key_of = [](const std::function<void(Study&)>& change) {
    Study study = good_study();
    change(study);
    return refused_key([&] { check(study); });
  };
  EXPECT_EQ(key_of([](Study&) {}), "accepted");
  EXPECT_EQ(key_of([](Study& s) { s.parameters.balls = 17; }), "balancer.balls");
  EXPECT_EQ(key_of([](Study& s) { s.parameters.balls = -1000000; }), "balancer.balls");
  EXPECT_EQ(key_of([](Study& s) { s.sampling.method = static_cast<SamplingMethod>(7); }), "sampling.method");
  EXPECT_EQ(key_of([](Study& s) { s.numerics.decide = static_cast<ClassificationMode>(-1); }), "numerics.decide");
  EXPECT_EQ(key_of([](Study& s) { s.sampling.seed = std::uint64_t{1} << 63; }), "sampling.seed");
  EXPECT_EQ(key_of([](Study& s) { s.parameters.rolling[1] = -0.1; }), "balancer.rolling");
  EXPECT_EQ(key_of([](Study& s) { s.parameters.contact_angle = -0.1; }), "balancer.contact_angle");
  EXPECT_EQ(key_of([](Study& s) { s.parameters.stiction[0] = std::nan(""); }), "balancer.stiction");
  EXPECT_EQ(key_of([](Study& s) {
              s.parameters.rolls = true;
              s.parameters.ball_radius[1] = 1.0;
            }),
            "balancer.ball_radius");
  // A motor by stall torque whose law says table is ambiguous.
  EXPECT_EQ(key_of([](Study& s) {
              s.speed.profile = Profile::torque;
              s.parameters.inertia = 1.0;
              s.speed.torque = {};
              s.speed.torque.by_stall = true;
              s.speed.torque.stall = s.speed.torque.no_load_speed = 1.0;
              s.speed.torque.kind = model::MotorLaw::Kind::table;
            }),
            "speed.torque.times");
}

TEST(Check, NamesTheStudyAndNoLineOfATextThatNobodyWrote) {
  Study study = good_study();
  study.speed.duration = -1.0;
  EXPECT_EQ(refused([&] { check(study); }).where(), "code");
  study.name.clear();
  EXPECT_EQ(refused([&] { check(study); }).where(), "study");
}

// A number that is mostly good, and sometimes one of the rarely good ones.
class Draw {
 public:
  explicit Draw(unsigned seed) : bits_(seed) {}
  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  bool rarely() { return below(40) == 0; }
  double number() {
    constexpr double odd[] = {0.0, -0.0, -1.0, 1e301, -1e301, 5e-324, 1e-15, 3.0, 1e7, 1e8};
    if (rarely()) return std::numeric_limits<double>::quiet_NaN();
    if (rarely()) return std::numeric_limits<double>::infinity();
    if (below(12) == 0) return odd[below(std::size(odd))];
    return 0.01 + static_cast<double>(below(1000)) / 300.0;
  }
  std::optional<double> maybe() { return below(3) == 0 ? std::optional(number()) : std::nullopt; }
  std::vector<double> numbers() {
    std::vector<double> list;
    for (std::uint64_t k = below(4); k > 0; --k) list.push_back(list.empty() && below(4) ? 0.0 : number());
    if (below(4)) std::sort(list.begin(), list.end());
    return list;
  }

 private:
  std::mt19937_64 bits_;
};

void draw_ramp(Draw& draw, RampSetting& s, bool driven_too) {
  constexpr int no_profile = static_cast<int>(profile_names.size());
  s.profile = static_cast<Profile>(draw.rarely() ? no_profile : draw.below(driven_too ? 5 : 4));
  s.speed = draw.number();
  s.initial = draw.number();
  s.final = draw.number();
  s.duration = draw.number();
  s.peak = draw.number();
  s.rise_until = draw.number();
  s.hold_until = s.rise_until + (draw.rarely() ? -1.0 : 1.0);
  s.fall_until = s.hold_until + (draw.rarely() ? -1.0 : 1.0);
  s.times = draw.numbers();
  s.speeds = draw.numbers();
}

Study drawn_study(unsigned seed) {
  Draw draw(seed);
  Study s;
  s.name = "drawn";
  model::Parameters& p = s.parameters;
  p.balls = draw.rarely() ? 0 : 1 + static_cast<int>(draw.below(8));
  p.eccentricity = draw.number();
  p.damping = {draw.number(), draw.number()};
  p.stiffness = {1.0, draw.below(3) ? 1.0 : draw.number()};
  p.gravity = draw.below(3) ? 0.0 : draw.number();
  p.inertia = draw.below(2) ? 1.0 : draw.number();
  for (double& m : p.mass) m = draw.rarely() ? draw.number() : 0.05;
  for (double& d : p.drag) d = draw.rarely() ? draw.number() : 0.05;
  if (draw.below(4) == 0) p.race_offset = {draw.number(), 0.0};
  if (draw.below(4) == 0) p.rolling[draw.below(8)] = draw.number();
  if (draw.below(4) == 0) p.stiction[draw.below(8)] = draw.number();
  if (draw.below(4) == 0) p.rolls = true;
  if (draw.below(8) == 0) p.ball_radius[draw.below(8)] = draw.number();
  if (draw.below(4) == 0) p.contact_angle = draw.number();
  if (draw.below(4) == 0) p.restitution = draw.number();
  draw_ramp(draw, s.speed, true);
  s.speed.stalled_below = draw.maybe();
  s.speed.law = draw.below(3) ? model::SpeedLaw::kinematic : model::SpeedLaw::published;
  TorqueSetting& t = s.speed.torque;
  t.kind = static_cast<model::MotorLaw::Kind>(draw.below(3));
  t.by_stall = draw.below(3) == 0;
  t.constant = draw.number();
  t.slope = draw.number();
  t.until = draw.maybe();
  t.stall = draw.number();
  t.no_load_speed = draw.number();
  t.times = draw.numbers();
  t.values = draw.numbers();
  t.gain = draw.number();
  t.integral = draw.number();
  t.limit = draw.maybe();
  draw_ramp(draw, t.target, false);
  if (draw.below(3) == 0) s.release.speed = draw.below(2) ? draw.number() : s.speed.final;
  if (draw.below(3) == 0) s.release.time = draw.number();
  for (double* v : {&s.initial.psi, &s.initial.x, &s.initial.y, &s.initial.x_dot, &s.initial.y_dot})
    *v = draw.below(2) ? 0.0 : draw.number();
  if (draw.below(4) == 0) s.initial.phi_dot[draw.below(8)] = draw.number();
  if (draw.below(3) == 0) s.sampling.method = static_cast<SamplingMethod>(draw.below(3));
  if (draw.below(5) == 0) s.sampling.starts = draw.below(3);
  if (draw.below(4) == 0) s.sampling.box.x = SamplingBox::Side{draw.number(), 4.0};
  s.numerics.tolerance = draw.below(4) ? std::nullopt : std::optional(1e-3 * draw.number());
  s.numerics.horizon = draw.maybe();
  s.numerics.decide = static_cast<ClassificationMode>(draw.below(3));
  s.limits.force = draw.maybe();
  s.limits.settled = draw.maybe();
  if (draw.below(4) == 0) s.scales = model::Scales{draw.number(), draw.number(), draw.number()};
  return s;
}

TEST(Check, SaysOfAStudyWhatTheReaderSaysOfItsText) {
  int accepted = 0, refusals = 0;
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    const Study study = drawn_study(seed);
    const auto as_is = refusal([&] { check(study); });
    const auto as_text = refusal([&] { parse_study(to_toml(study), "drawn"); });
    ASSERT_EQ(as_is.has_value(), as_text.has_value()) << to_toml(study);
    if (as_is) {
      ++refusals;
      EXPECT_EQ(as_is->place().name, as_text->place().name);
      EXPECT_EQ(as_is->key(), as_text->key());
      EXPECT_EQ(as_is->value(), as_text->value());
      EXPECT_EQ(as_is->problem(), as_text->problem());
    } else {
      ++accepted;
      EXPECT_EQ(first_difference(study_from(to_tree(study)), parse_study(to_toml(study), "drawn")), "");
    }
  }
  EXPECT_GT(accepted, 50);  // the draw has both kinds, so neither result is accidental
  EXPECT_GT(refusals, 100);
}

}  // namespace study_tree_test
}  // namespace equipoise
