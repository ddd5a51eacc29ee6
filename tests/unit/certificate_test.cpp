// Certificates: every stable case of the paper is proved nearly up to the sampled critical level, and nothing false is
// proved.
#include "equipoise/classification/proved_regions/certificate.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "../support/refusals.hpp"
#include "../support/studies.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace certificate_test {

using namespace equipoise;

model::Parameters balancer(double beta, std::vector<double> masses = {0.05, 0.05}, double lambda = 0.01) {
  model::Parameters p;
  p.balls = static_cast<int>(masses.size());
  p.eccentricity = lambda;
  for (int i = 0; i < p.balls; ++i) p.mass[i] = masses[i];
  for (int i = 0; i < p.balls; ++i) p.drag[i] = beta;
  return p;
}

// A balanced state with the form and sampled level that the program uses.
struct Case {
  model::Parameters p;
  double speed;
  std::array<double, model::max_balls> phi{};
  Eigen::MatrixXd form;
  double critical = 0.0;
};

Case case_of(const model::Parameters& p, double speed, std::size_t state = 0) {
  const BalancedRegion region = analyse_balanced({p, speed}).regions.at(state);
  const int size = model::dimension(p.balls);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> factor(
      region.factor.data(), size, size);
  Case c{p, speed, {}, factor.transpose() * factor, region.level / level_margin};
  std::copy_n(region.angles(), p.balls, c.phi.begin());
  return c;
}

CertificateResult prove(const Case& c, double share, Certificate& certificate) {
  return prove_level({c.p, c.speed}, c.phi.data(), c.form, share * c.critical, certificate);
}

// Measured shares are 0.95 to 0.99; users were promised 0.85.
constexpr double promised_share = 0.85;

void expect_proved(const Case& c) {
  SCOPED_TRACE(fmt::format("beta {}, speed {}", c.p.drag[0], c.speed));
  std::string reason;
  const Certificate found = largest_certificate({c.p, c.speed}, c.phi.data(), c.form, c.critical, &reason);
  EXPECT_GE(found.level, promised_share * c.critical) << reason;
  // The sampled critical level is one at which V does not decrease.
  EXPECT_LT(found.level, c.critical);
  const CertificateResult check = check_certificate(found);
  EXPECT_TRUE(check.proved) << check.reason;
}

struct Row {
  double drag, speed;
};
class CertificateOf : public testing::TestWithParam<Row> {};
TEST_P(CertificateOf, ARowOfThePaperIsProved) { expect_proved(case_of(balancer(GetParam().drag), GetParam().speed)); }

std::vector<Row> stable_cases_of_table_1() {
  std::vector<Row> rows;
  for (double beta : {0.01, 0.05, 0.1, 0.25})
    for (double speed : {1.5, 2.0, 3.0, 4.0, 5.0, 6.0})
      if (!(beta == 0.01 && speed <= 2.0) && !(beta == 0.05 && speed == 1.5)) rows.push_back({beta, speed});
  return rows;
}
INSTANTIATE_TEST_SUITE_P(Table1, CertificateOf, testing::ValuesIn(stable_cases_of_table_1()));

std::vector<Row> rows_of_table_2() {
  std::vector<Row> rows;
  for (int k = 0; k <= 15; ++k) rows.push_back({0.05, 2.0 + 0.2 * k});
  return rows;
}
INSTANTIATE_TEST_SUITE_P(Table2, CertificateOf, testing::ValuesIn(rows_of_table_2()));

TEST(Certificate, ProvesTheOtherStateTheStateOfOneBallAndTurningBackwards) {
  expect_proved(case_of(balancer(0.05), 2.4, 1));
  expect_proved(case_of(balancer(0.05, {0.01}), 3.0));
  expect_proved(case_of(balancer(0.05), -3.0));
}

TEST(Certificate, ProvesBothStatesOfUnequalBalls) {
  model::Parameters unequal = balancer(0.05, {0.03, 0.034});
  unequal.drag[1] = 0.08;
  for (std::size_t state : {0, 1}) expect_proved(case_of(unequal, 2.4, state));
}

TEST(Certificate, ProvesBallsThatRollAndIsNotOneOfBallsThatSlide) {
  model::Parameters rolling = balancer(0.05);
  rolling.rolls = true;
  for (double speed : {2.4, 5.0}) expect_proved(case_of(rolling, speed));
  Certificate one;
  ASSERT_TRUE(prove(case_of(rolling, 2.4), 0.9, one).proved);
  EXPECT_TRUE(
      check_certificate(certificates_from_json(certificates_json(Certificates{{one}, {}}), "file").states.front())
          .proved);
  one.parameters.rolls = false;
  EXPECT_FALSE(check_certificate(one).proved);
}

TEST(Certificate, SetsHoldNoPointWhereVGrows) {
  for (const auto& [beta, speed] : {std::pair{0.01, 3.0}, {0.05, 2.0}, {0.05, 2.4}, {0.25, 4.0}}) {
    const Case c = case_of(balancer(beta), speed);
    const Certificate found = largest_certificate({c.p, speed}, c.phi.data(), c.form, c.critical);
    ASSERT_GT(found.level, 0.0);
    const Eigen::MatrixXd factor = equipoise::dense::Cholesky(found.form).upper();
    const Eigen::VectorXd centre = model::centred_state(c.p, c.phi.data());
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    Eigen::VectorXd direction(8);
    double worst = -1e300;
    for (int i = 0; i < 50000; ++i) {
      for (double& v : direction) v = normal(random);
      // A third each: on the surface, anywhere inside, close to the centre.
      const double radius = i % 3 == 0 ? 1.0 : i % 3 == 1 ? std::pow(uniform(random), 1.0 / 8) : 0.1 * uniform(random);
      const Eigen::VectorXd d = factor.triangularView<Eigen::Upper>().solve(
          Eigen::VectorXd(std::sqrt(found.level) * radius * direction.normalized()));
      const Eigen::VectorXd rate = model::derivative(c.p, speed, Eigen::VectorXd(centre + d).data());
      worst = std::max(worst, 2.0 * d.dot(found.form * rate) / d.dot(found.form * d));
    }
    EXPECT_LT(worst, 0.0) << beta << " " << speed;
  }
}

TEST(Certificate, IsRefusedAboveTheSampledCriticalLevel) {
  for (const auto& [beta, speed] : {std::pair{0.01, 3.0}, {0.05, 2.4}, {0.25, 2.0}}) {
    const Case c = case_of(balancer(beta), speed);
    Certificate certificate;
    for (double share : {1.001, 1.1, 3.0}) {  // 1e-3: beyond the search's own resolution
      const CertificateResult result = prove(c, share, certificate);
      EXPECT_FALSE(result.proved) << share;
      EXPECT_FALSE(result.reason.empty());
      EXPECT_EQ(certificate.level, 0.0);
    }
  }
}

// Overdamped balls on damped supports have rates from 1e-3 to 5. Level sets are narrow, and 20 000 random rays find a
// level several times too high. The mirrored form tries other directions of the same V.
TEST(CriticalLevel, DoesNotDependOnTheSenseOfTurning) {
  for (const std::vector<double>& masses : {std::vector{0.00434, 0.00434}, {0.00434, 0.005}, {0.0083}}) {
    model::Parameters p = balancer(5.2, masses, 0.0083);
    p.damping = {0.883, 0.883};
    const BalancedAnalysis forwards = analyse_balanced({p, 2.0}), backwards = analyse_balanced({p, -2.0});
    ASSERT_FALSE(forwards.regions.empty());
    ASSERT_EQ(forwards.regions.size(), backwards.regions.size());
    Eigen::VectorXd sign = -Eigen::VectorXd::Ones(model::dimension(p.balls));
    sign[model::index::x] = sign[model::index::u] = 1.0;
    for (const BalancedRegion& region : forwards.regions) {
      double nearest = 1.0;  // the computation is the same but for its last roundings
      for (const BalancedRegion& other : backwards.regions)
        nearest = std::min(nearest, std::fabs(other.level / region.level - 1.0));
      EXPECT_LT(nearest, 1e-9);
      std::array<double, model::max_balls> phi{};
      for (int i = 0; i < p.balls; ++i) phi[i] = -region.angles()[i];
      const Eigen::MatrixXd mirrored = sign.asDiagonal() * form_of(region) * sign.asDiagonal();
      Directions vectors(mirrored.rows());
      const double level = critical_level({p, -2.0}, model::centred_state(p, phi.data()), mirrored, 20000, vectors);
      // level_margin leaves a tenth for the search's error.
      EXPECT_NEAR(level_margin * level / region.level, 1.0, 0.1);
    }
  }
}

TEST(Certificate, IsRefusedForFormsThatAreWrong) {
  const Case c = case_of(balancer(0.05), 2.4);
  const auto reason = [&](const Eigen::MatrixXd& form, double level) {
    Certificate certificate;
    const CertificateResult result = prove_level({c.p, c.speed}, c.phi.data(), form, level, certificate);
    EXPECT_FALSE(result.proved);
    return result.reason;
  };
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(8, 8);
  std::srand(3);
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(8, 8);
  for (double level : {1e-3, 1e-9}) {
    EXPECT_EQ(reason(unit, level), "V does not decrease along the linearised equations");
    EXPECT_EQ(reason(random * random.transpose() + unit, level), "V does not decrease along the linearised equations");
    EXPECT_EQ(reason(c.form - 10.0 * c.form.norm() * unit, level), "the form is not positive definite");
    EXPECT_EQ(reason(Eigen::MatrixXd::Identity(6, 6), level), "the form must be a 8 x 8 matrix of finite numbers");
  }
  EXPECT_EQ(reason(c.form, -1.0), "the level must be a finite number greater than 0");
  EXPECT_EQ(reason(c.form, 1e9), "the level set reaches around the race");
}

TEST(Certificate, IsRefusedWithAReasonWhereThereIsNothingToProve) {
  const auto reason = [](const model::Parameters& p, double speed, std::array<double, 3> phi) {
    Certificate certificate;
    const int size = model::dimension(p.balls);
    const CertificateResult result =
        prove_level({p, speed}, phi.data(), Eigen::MatrixXd::Identity(size, size), 1e-4, certificate);
    EXPECT_FALSE(result.proved);
    EXPECT_EQ(largest_certificate({p, speed}, phi.data(), Eigen::MatrixXd::Identity(size, size), 1e-4).level, 0.0);
    return result.reason;
  };
  EXPECT_NE(reason(balancer(0.01), 1.5, {1.67096, -1.67096}).find("not linearly stable at speed 1.5"),
            std::string::npos);
  EXPECT_NE(reason(balancer(0.05, {0.05, 0.05, 0.05}), 3.0, {1.0, 3.0, 5.0}).find("continuum"), std::string::npos);
  EXPECT_NE(reason(balancer(0.05, {0.05, 0.05}, 0.0), 3.0, {0.0, 3.14}).find("continuum"), std::string::npos);
  EXPECT_NE(reason(balancer(0.05, {0.05, 0.02}), 3.0, {0.0, 3.14}).find("no balanced state"), std::string::npos);
  model::Parameters p = balancer(0.05);
  p.stiffness[1] = 2.0;
  EXPECT_NE(reason(p, 3.0, {1.67096, -1.67096}).find("equal values in x and y"), std::string::npos);
  p = balancer(0.05);
  p.gravity = 0.1;
  EXPECT_NE(reason(p, 3.0, {1.67096, -1.67096}).find("gravity"), std::string::npos);
}

TEST(Certificate, IsRefutedOnceAnythingInItIsChanged) {
  const Case c = case_of(balancer(0.05), 2.4);
  Certificate good;
  ASSERT_TRUE(prove(c, 0.9, good).proved);
  ASSERT_TRUE(check_certificate(good).proved);
  const auto refuted = [&](auto&& change) {
    Certificate bad = good;
    change(bad);
    const CertificateResult result = check_certificate(bad);
    return !result.proved && !result.reason.empty();
  };
  const std::size_t middle = good.boxes.size() / 2;
  for (std::size_t i : {std::size_t{0}, middle, good.boxes.size() - 1}) {
    EXPECT_TRUE(refuted([&](Certificate& b) { b.boxes.erase(b.boxes.begin() + static_cast<std::ptrdiff_t>(i)); }));
    EXPECT_TRUE(refuted([&](Certificate& b) { b.boxes.push_back(b.boxes[i]); }));
    EXPECT_TRUE(refuted([&](Certificate& b) { b.boxes[i].high[0] += 1e-9; }));
    EXPECT_TRUE(refuted([&](Certificate& b) { b.boxes[i].low[1] = std::nan(""); }));
    EXPECT_TRUE(refuted([&](Certificate& b) { b.boxes[i].multiplier[1] = -1e-6; }));
    EXPECT_TRUE(refuted([&](Certificate& b) { b.boxes[i].multiplier[2] = INFINITY; }));
    EXPECT_TRUE(refuted([&](Certificate& b) { b.boxes[i].multiplier[3] = 10.0; }));
  }
  EXPECT_TRUE(refuted([](Certificate& b) { b.boxes.clear(); }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.level *= 1.05; }));  // the frame no longer fits
  EXPECT_TRUE(refuted([](Certificate& b) {                        // nor do the boxes cover a set of 1.2 times the level
    b.level *= 1.2;
    b.frame *= std::sqrt(1.2);
  }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.level = 0.0; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.phi[0] += 1e-9; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.phi = {}; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.form(2, 3) *= 1.0 + 1e-6; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.form(4, 4) = std::nan(""); }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.frame(0, 0) *= 1.0 + 1e-6; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.speed = 2.0; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.parameters.drag[0] = 0.01; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.parameters.mass[1] = 0.04; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.parameters.balls = 1; }));
  EXPECT_TRUE(refuted([](Certificate& b) { b.parameters.balls = 3; }));
}

TEST(Certificate, OrderOfBoxesIsFree) {
  const Case c = case_of(balancer(0.05), 2.4);
  Certificate certificate;
  ASSERT_TRUE(prove(c, 0.9, certificate).proved);
  std::shuffle(certificate.boxes.begin(), certificate.boxes.end(), std::mt19937_64(5));
  EXPECT_TRUE(check_certificate(certificate).proved);
}

TEST(Certificate, CoversTheRegionThatAProgramTestsInDoubles) {
  // The program's V, from a rounded factor about rounded angles, against the exact form's: apart by far less than
  // level_slack.
  const Case c = case_of(balancer(0.01), 6.0);
  const BalancedRegion region = analyse_balanced({c.p, c.speed}).regions.front();
  const int size = 8;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Eigen::VectorXd e(size);
    for (double& v : e) v = normal(random);
    const Eigen::MatrixXd factor = equipoise::dense::Cholesky(c.form).upper();
    const Eigen::VectorXd d = factor.triangularView<Eigen::Upper>().solve(e.normalized());
    double v = 0.0;
    for (int row = 0; row < size; ++row) {
      double sum = 0.0;
      for (int k = row; k < size; ++k) sum += region.factor[row * size + k] * d[k];
      v += sum * sum;
    }
    EXPECT_NEAR(v, 1.0, 1e-2 * level_slack);
  }
}

TEST(CertificateJson, GivesTheSameBitsBack) {
  std::vector<Certificate> written(2);
  ASSERT_TRUE(prove(case_of(balancer(0.05), 2.4), 0.9, written[0]).proved);
  ASSERT_TRUE(prove(case_of(balancer(0.05, {0.01}), 3.0), 0.9, written[1]).proved);
  const std::string text = certificates_json(Certificates{written, {}});
  const std::vector<Certificate> read = certificates_from_json(text, "file").states;
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(certificates_json(Certificates{read, {}}), text);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].form, written[i].form);
    EXPECT_EQ(read[i].frame, written[i].frame);
    EXPECT_EQ(read[i].level, written[i].level);
    EXPECT_EQ(read[i].phi, written[i].phi);
    ASSERT_EQ(read[i].boxes.size(), written[i].boxes.size());
    for (std::size_t b = 0; b < read[i].boxes.size(); ++b) {
      EXPECT_EQ(read[i].boxes[b].low, written[i].boxes[b].low);
      EXPECT_EQ(read[i].boxes[b].high, written[i].boxes[b].high);
      EXPECT_EQ(read[i].boxes[b].multiplier, written[i].boxes[b].multiplier);
    }
    EXPECT_TRUE(check_certificate(read[i]).proved);
  }
}

TEST(CertificateJson, IsNotReadOnceStopped) {
  std::vector<Certificate> one(1);
  ASSERT_TRUE(prove(case_of(balancer(0.05, {0.01}), 3.0), 0.9, one[0]).proved);
  const std::string text = certificates_json(Certificates{one, {}});
  const StopFlag stop{true};
  EXPECT_TRUE(certificates_from_json(text, "file", &stop).states.empty());
  EXPECT_FALSE(checked_certificates(text, "file", &stop).proved());
}

TEST(CertificateJson, NamesWhatDoesNotFit) {
  std::vector<Certificate> one(1);
  ASSERT_TRUE(prove(case_of(balancer(0.05, {0.01}), 3.0), 0.9, one[0]).proved);
  const std::string good = certificates_json(Certificates{one, {}});
  const auto complaint = [](const std::string& text) {
    return refusal_text([&] { certificates_from_json(text, "file"); });
  };
  const auto with = [&](const char* from, const char* to) { return equipoise::with(good, from, to); };
  EXPECT_EQ(complaint(good), "");
  EXPECT_NE(complaint("").find("is not JSON"), std::string::npos);
  EXPECT_NE(complaint(good.substr(0, good.size() / 2)).find("is not JSON"), std::string::npos);
  EXPECT_NE(complaint("[]").find("format"), std::string::npos);
  EXPECT_NE(complaint("{\"format\": 7}").find("format"), std::string::npos);
  EXPECT_NE(complaint(with("certificate 1", "certificate 9")).find("format"), std::string::npos);
  EXPECT_NE(complaint(with("\"balls\": 1", "\"balls\": 3")).find("balls"), std::string::npos);
  EXPECT_NE(complaint(with("\"balls\": 1", "\"balls\": 2")).find("mass"), std::string::npos);
  EXPECT_NE(complaint(with("\"speed\": 3.0", "\"speed\": null")).find("speed"), std::string::npos);
  EXPECT_NE(complaint(with("\"speed\"", "\"sped\"")).find("speed: is missing"), std::string::npos);
  EXPECT_NE(complaint(with("\"mass\": [0.01]", "\"mass\": [-0.01]")).find("mass"), std::string::npos);
  EXPECT_NE(complaint(with("\"boxes\": [", "\"boxes\": [[1],")).find("boxes"), std::string::npos);
}

TEST(Certify, ProvesAStudyAndSaysWhyItDoesNot) {
  const std::string& text = constant_speed;
  const CertifyResult result = certify(parse_study(text, "study"));
  EXPECT_TRUE(result.proved());
  ASSERT_EQ(result.states.size(), 1u);
  EXPECT_EQ(result.states[0].copies, 2);
  EXPECT_GT(result.states[0].reach[0], 0.0);
  EXPECT_NE(certify_text(result).find("re-check"), std::string::npos);
  std::istringstream lines(certify_text(result, TextStyle{}));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  const CertifyResult unstable = certify(parse_study(text, "study", {"speed.speed=1.5"}));
  EXPECT_FALSE(unstable.proved());
  EXPECT_NE(unstable.note.find("unstable at speed 1.5"), std::string::npos);
  EXPECT_NE(certify(parse_study(text, "study", {"balancer.balls=3"})).note.find("continuum"), std::string::npos);
  EXPECT_THROW(certify(parse_study(text, "study", {"rotor.stiffness=[1.0,2.0]"})), InputError);
}

}  // namespace certificate_test
