// A study's form: stated keys, possible keys, and the study recovered from a filled-in form.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/report/html/form.hpp"
#include "../support/files.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace form_test {

const std::string machine = with(ramp_machine, "final = \"3000 rpm\"", "initial = \"0 rpm\"\nfinal = \"1500 rpm\"");

const FormField* find(const std::vector<FormField>& form, const std::string& key) {
  const auto at = std::find_if(form.begin(), form.end(), [&](const FormField& f) { return f.key == key; });
  return at == form.end() ? nullptr : &*at;
}

// A field as --set takes it.
std::string override_of(const FormField& f) {
  if (f.kind == FormField::Kind::list) {
    std::string entries;
    for (std::size_t at = 0; at <= f.value.size();) {
      const std::size_t comma = std::min(f.value.find(", ", at), f.value.size());
      const std::string entry = f.value.substr(at, comma - at);
      entries += (entries.empty() ? "" : ", ") + (f.unit.empty() ? entry : "\"" + entry + " " + f.unit + "\"");
      at = comma + 2;
    }
    return f.key + "=[" + entries + "]";
  }
  return f.key + "=" + f.value + (f.unit.empty() ? "" : " " + f.unit);
}

TEST(Form, ShowsQuantitiesWithTheirUnits) {
  const std::vector<FormField> form = form_of(machine, "machine");
  const FormField* mass = find(form, "rotor.mass");
  ASSERT_TRUE(mass);
  EXPECT_EQ(mass->value, "12");
  EXPECT_EQ(mass->unit, "kg");
  EXPECT_EQ(mass->units, (std::vector<std::string>{"kg", "g", "mg"}));
  EXPECT_EQ(mass->kind, FormField::Kind::number);
  EXPECT_TRUE(mass->given);
  EXPECT_NE(mass->allowed.find("a mass"), std::string::npos) << mass->allowed;
  const FormField* speed = find(form, "speed.final");
  ASSERT_TRUE(speed);
  EXPECT_EQ(speed->label, "final speed");
  EXPECT_EQ(find(form, "balancer.race_radius")->label, "race radius");
  EXPECT_EQ(find(form, "initial.phi_dot")->label, "ball rates");
  EXPECT_EQ(speed->unit, "rpm");
}

TEST(Form, HasAFieldForEveryKeyOfAPlace) {
  const std::string bare = with(machine, "eccentricity = \"0.2 mm\"\n", "");
  const std::string place = "[[place]]\nmass = \"24 g\"\nradius = \"100 mm\"\nangle = \"90 degree\"\n";
  const std::vector<FormField> form = form_of(bare + place + place, "machine");
  const FormField* mass = find(form, "place.2.mass");
  ASSERT_TRUE(mass);
  EXPECT_EQ(mass->label, "mass");
  EXPECT_EQ(mass->value, "24");
  EXPECT_EQ(mass->unit, "g");
  EXPECT_TRUE(mass->given);
  EXPECT_FALSE(find(form, "place.3.mass"));
  // The resultant is no unbalance of the rotor's own: stated as that, it would count twice.
  EXPECT_FALSE(find(form, "rotor.unbalance"));
  EXPECT_FALSE(find(form, "rotor.eccentricity"));
  EXPECT_EQ(find(form_of(machine + place, "machine"), "rotor.eccentricity")->value, "0.2");
}

TEST(Form, NamesTheTableWithinATable) {
  const std::string oiled = with(machine, "drag = ", "ball_diameter = \"8 mm\"\n# drag = ");
  const std::vector<FormField> form = form_of(
      with(oiled, "[balancer]\n", "[balancer]\noil = { grade = \"ISO VG 32\", at = \"40 degC\" }\n"), "machine");
  ASSERT_TRUE(find(form, "balancer.oil.at"));
  EXPECT_EQ(find(form, "balancer.oil.at")->label, "oil at");
  EXPECT_EQ(find(form, "balancer.oil.grade")->label, "oil grade");
  const std::vector<FormField> graded = form_of(
      with(machine, "eccentricity = \"0.2 mm\"\n", "balance_grade = { grade = \"G 16\", at = \"1500 rpm\" }\n"), "m");
  ASSERT_TRUE(find(graded, "rotor.balance_grade.grade"));
  EXPECT_EQ(find(graded, "rotor.balance_grade.grade")->label, "balance grade");
}

TEST(Form, OffersWhatMayBeStatedBesides) {
  const std::string judged = std::string(machine) + "[standards]\nhand_held = true\n";
  const std::vector<FormField> form = form_of(judged, "machine");
  ASSERT_TRUE(find(form, "standards.hand_held"));
  const std::vector<OfferedKey> offered = offered_keys(parse_study(judged, "machine"), form);
  const auto offers = [&](const std::string& key) {
    return std::count_if(offered.begin(), offered.end(), [&](const OfferedKey& o) { return o.key == key; });
  };
  for (const char* key : {"limits.velocity", "limits.clearance", "standards.severity_class", "release.speed"})
    EXPECT_EQ(offers(key), 1) << key;
  for (const char* key : {"standards.hand_held", "rotor.mass", "speed.peak", "balancer.oil.at"})
    EXPECT_EQ(offers(key), 0) << key;
  for (const OfferedKey& o : offered) EXPECT_FALSE(o.sentence.empty()) << o.key;
}

// A study's echo omits angles that nobody chose; the form offers those in effect.
TEST(Form, OffersTheAnglesWhereBallsStart) {
  const std::vector<FormField> form = form_of(constant_speed, "rotor");
  const FormField* angles = find(form, "initial.phi");
  ASSERT_TRUE(angles);
  EXPECT_EQ(angles->value, "0, 3.141592653589793");
  EXPECT_FALSE(angles->given);
  EXPECT_EQ(find(form_of(machine, "machine"), "release.time")->value, "0");
}

TEST(Form, KnowsChoicesWholeNumbersAndFlags) {
  const std::vector<FormField> form = form_of(constant_speed, "rotor");
  const FormField* profile = find(form, "speed.profile");
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->kind, FormField::Kind::choice);
  EXPECT_EQ(profile->choices, (std::vector<std::string>{"constant", "ramp", "trapezoid", "points", "hill", "torque"}));
  const FormField* balls = find(form, "balancer.balls");
  ASSERT_TRUE(balls);
  EXPECT_EQ(balls->kind, FormField::Kind::whole);
  const FormField* damping = find(form, "rotor.damping");
  ASSERT_TRUE(damping);
  EXPECT_NE(damping->allowed.find("at least 0"), std::string::npos) << damping->allowed;
}

TEST(Form, OffersDefaultsThatStandBesideWhatIsWritten) {
  const std::vector<FormField> form = form_of(constant_speed, "rotor");
  const FormField* gravity = find(form, "rotor.gravity");
  ASSERT_TRUE(gravity);
  EXPECT_FALSE(gravity->given);
  EXPECT_EQ(gravity->value, "0");
  // A stated unbalance is not offered again as an eccentricity.
  const std::string unbalanced = with(machine, "eccentricity = \"0.2 mm\"", "unbalance = \"2400 g mm\"");
  EXPECT_FALSE(find(form_of(unbalanced, "machine"), "rotor.eccentricity"));
  EXPECT_TRUE(find(form_of(unbalanced, "machine"), "rotor.unbalance"));
}

TEST(Form, EveryFieldIsAnOverride) {
  std::vector<std::string> texts{constant_speed, machine};
  for (const auto& entry : std::filesystem::directory_iterator(EQUIPOISE_SOURCE_DIR "/studies/new"))
    texts.push_back(content(entry.path().string()));
  EXPECT_GT(texts.size(), 2u);
  for (const std::string& text : texts) {
    const std::string echo = to_toml(parse_study(text, "study"));
    for (const FormField& f : form_of(text, "study")) {
      if (!f.given) continue;
      EXPECT_EQ(to_toml(parse_study(text, "study", {override_of(f)})), echo) << override_of(f);
    }
  }
}

TEST(Form, OffersTheMaterialsOfBalls) {
  const std::string of_steel = with(machine, "mass = \"60 g\"", "ball_diameter = \"8 mm\"\nball_material = \"steel\"");
  const std::vector<FormField> form = form_of(of_steel, "machine");
  const FormField* material = find(form, "balancer.ball_material");
  ASSERT_TRUE(material);
  EXPECT_EQ(material->choices,
            (std::vector<std::string>{"steel", "stainless steel", "tungsten carbide", "ceramic", "glass"}));
}

TEST(Form, ShowsADistributionAsItIsWritten) {
  const std::string drawn = with(machine, "mass = \"60 g\"", "mass = { uniform = [\"50 g\", \"70 g\"] }");
  const std::vector<FormField> form = form_of(drawn, "machine");
  const FormField* mass = find(form, "balancer.mass");
  ASSERT_TRUE(mass);
  EXPECT_EQ(mass->value, "{ uniform = [\"50 g\", \"70 g\"] }");
}

TEST(Form, OverridesAreWrittenIntoTheText) {
  const std::string text = with_overrides(machine, "machine", {"rotor.mass=13 kg", "speed.final=1400 rpm"});
  EXPECT_EQ(to_toml(parse_study(text, "machine")),
            to_toml(parse_study(machine, "machine", {"rotor.mass=13 kg", "speed.final=1400 rpm"})));
  EXPECT_EQ(with_overrides(machine, "machine", {}), machine);
  EXPECT_THROW(form_of(machine, "machine", {"rotor.mass=13 m"}), InputError);
}

}  // namespace form_test
}  // namespace equipoise
