// Proofs about members of a continuum: true at random points of the equations, consistent with linear theory, and
// refuted once anything in them is changed.
#include "equipoise/extras/proof/certify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "equipoise/attractors/equilibria/continuum_draws.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace member_certificate_test {

using namespace equipoise;

model::Parameters balancer(int balls, bool unlike = false) {
  model::Parameters p;
  p.balls = balls;
  p.eccentricity = 0.01;
  for (int i = 0; i < balls; ++i) {
    p.mass[i] = 0.05 + (unlike ? 0.004 * i : 0.0);
    p.drag[i] = 0.05 + (unlike ? 0.01 * i : 0.0);
  }
  p.rolls = unlike;
  return p;
}

// h in the certificate's units, and its rate from the equations in doubles.
Eigen::VectorXd h_of(const model::Parameters& p, const Eigen::VectorXd& z, const Eigen::VectorXd* rate) {
  const int n = p.balls;
  Eigen::VectorXd h(n + 6);
  const Eigen::VectorXd& v = rate ? *rate : z;
  h.head(4) = v.head(4) / p.all_unbalances();
  double ux = rate ? 0.0 : p.eccentricity, uy = 0.0;
  for (int i = 0; i < n; ++i) {
    const double phi = z[model::index::phi(i)], q = z[model::index::q(i, n)];
    h[4 + i] = v[model::index::q(i, n)];
    ux += p.mass[i] * (rate ? -q * std::sin(phi) : std::cos(phi));
    uy += p.mass[i] * (rate ? q * std::cos(phi) : std::sin(phi));
  }
  h[4 + n] = ux / p.all_unbalances();
  h[5 + n] = uy / p.all_unbalances();
  return h;
}

// The largest (dV/dt + 2 rate V) / |h|^2 at random states of the certificate's box.
double worst(const MemberCertificate& c) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const model::Parameters& p = c.parameters;
  const double fastest = c.attracts ? 0.5 * c.rate * c.radius : c.radius;
  double result = -INFINITY;
  for (int k = 0; k < 2000; ++k) {
    Eigen::VectorXd z(model::dimension(p.balls));
    const double size = std::pow(10.0, -4.0 * std::fabs(uniform(random)));
    for (int i = 0; i < 4; ++i) z[i] = 0.1 * size * uniform(random);
    for (int i = 0; i < p.balls; ++i) {
      z[model::index::phi(i)] = c.phi[i] + c.radius * uniform(random);
      z[model::index::q(i, p.balls)] = fastest * uniform(random);
    }
    const Eigen::VectorXd rate = model::derivative(p, c.speed, z.data());
    const Eigen::VectorXd h = h_of(p, z, nullptr), change = h_of(p, z, &rate);
    result = std::max(result, (2.0 * h.dot(c.form * change) + 2.0 * c.rate * h.dot(c.form * h)) / h.squaredNorm());
  }
  return result;
}

TEST(MemberCertificate, AgreesWithLinearTheoryAndHoldsInTheEquations) {
  struct Case {
    int balls;
    bool unlike;
    double speed;
  };
  int attracting = 0, unstable = 0;
  for (const Case& c : {Case{3, false, 2.4}, {4, false, 2.4}, {4, true, 3.0}, {8, false, 2.4}}) {
    const model::Parameters p = balancer(c.balls, c.unlike);
    ContinuumDraws draws(p);
    std::array<double, model::max_balls> phi{};
    for (int k = 0; k < 12; ++k) {
      ASSERT_TRUE(draws.next(phi));
      const MemberCertificate proof = prove_member(p, c.speed, phi.data());
      ASSERT_GT(proof.radius, 0.0) << c.balls;
      EXPECT_TRUE(check_member(proof).proved);
      // n - 2 eigenvalues of the Jacobian are 0, along the continuum, to rounding.
      Eigen::VectorXcd rates =
          dense::eigenvalues(model::jacobian(p, c.speed, model::centred_state(p, phi.data()).data()));
      double growth = -INFINITY;
      for (const auto& rate : rates)
        if (std::abs(rate) > 1e-6) growth = std::max(growth, rate.real());
      EXPECT_EQ(proof.attracts, growth < 0.0) << growth;
      EXPECT_NEAR(across_continuum(p, c.speed, phi.data()), growth, 1e-8);
      EXPECT_LT(worst(proof), 0.0) << c.balls;
      ++(proof.attracts ? attracting : unstable);
    }
  }
  EXPECT_GT(attracting, 5);
  EXPECT_GT(unstable, 20);
}

// Members proved to attract do, and those proved unstable are left. Followed in small steps of the classical method.
TEST(MemberCertificate, SaysWhereTrajectoriesGo) {
  const model::Parameters p = balancer(4);
  ContinuumDraws draws(p);
  std::array<double, model::max_balls> phi{};
  int seen[2] = {0, 0};
  for (int k = 0; k < 30 && (seen[0] < 2 || seen[1] < 2) && draws.next(phi); ++k) {
    const MemberCertificate c = prove_member(p, 2.4, phi.data());
    const double growth = across_continuum(p, 2.4, phi.data());
    // Fast enough to show within 3000 units.
    if (std::fabs(growth) < 4e-3 || seen[c.attracts]++ >= 2) continue;
    Eigen::VectorXd z = model::centred_state(p, phi.data());
    const double begin = c.attracts ? std::sqrt(c.level / c.form.norm()) : 1e-4;
    const auto v = [&] {
      const Eigen::VectorXd h = h_of(p, z, nullptr);
      return h.dot(c.form * h);
    };
    if (c.attracts)
      z[model::index::q(0, 4)] = begin;
    else
      for (int i = 0; i < 4; ++i) z[model::index::q(i, 4)] = begin * c.escape[4 + i];
    const double before = v();
    const double step = 0.02;
    const auto f = [&](const Eigen::VectorXd& y) { return model::derivative(p, 2.4, y.data()); };
    bool left = false;
    for (int i = 0; i < 150000 && !left; ++i) {
      const Eigen::VectorXd k1 = f(z), k2 = f(z + 0.5 * step * k1), k3 = f(z + 0.5 * step * k2), k4 = f(z + step * k3);
      z += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      for (int b = 0; b < 4; ++b) left = left || std::fabs(z[model::index::phi(b)] - c.phi[b]) > c.radius;
    }
    EXPECT_EQ(left, !c.attracts);
    if (c.attracts) {
      EXPECT_LE(before, c.level);
      EXPECT_LT(v(), 1e-6 * before);  // e^(-2 rate t) with 2 rate t of 12 and more, and half of it proved
    }
  }
  EXPECT_GE(seen[0], 2);
  EXPECT_GE(seen[1], 2);
}

TEST(MemberCertificate, IsRefutedOnceAnythingInItIsChanged) {
  const model::Parameters p = balancer(4);
  ContinuumDraws draws(p);
  std::array<double, model::max_balls> phi{};
  MemberCertificate attracting, unstable;
  while ((attracting.radius == 0.0 || unstable.radius == 0.0) && draws.next(phi)) {
    const MemberCertificate c = prove_member(p, 2.4, phi.data());
    (c.attracts ? attracting : unstable) = c;
  }
  const auto refuted = [](MemberCertificate c, auto&& change) {
    change(c);
    const CertificateResult result = check_member(c);
    return !result.proved && !result.reason.empty();
  };
  const auto both = [&](auto&& change) { return refuted(attracting, change) && refuted(unstable, change); };
  EXPECT_TRUE(refuted(attracting, [](auto& c) { c.level *= 1.01; }));
  EXPECT_TRUE(refuted(attracting, [](auto& c) { c.least *= 1.1; }));
  EXPECT_TRUE(refuted(attracting, [](auto& c) { c.rate *= 3.0; }));
  EXPECT_TRUE(refuted(attracting, [](auto& c) { c.attracts = false; }));
  EXPECT_TRUE(refuted(unstable, [](auto& c) { c.attracts = true; }));
  EXPECT_TRUE(refuted(unstable, [](auto& c) { c.escape.setZero(); }));
  EXPECT_TRUE(refuted(unstable, [](auto& c) { c.escape.resize(3); }));
  EXPECT_TRUE(refuted(unstable, [](auto& c) { c.phi[0] += 0.1; }));  // no balance there
  EXPECT_TRUE(both([](auto& c) { c.radius = 0.5; }));
  EXPECT_TRUE(both([](auto& c) { c.form(0, 0) = std::nan(""); }));
  EXPECT_TRUE(both([](auto& c) { c.form(1, 2) += 0.1; }));  // not symmetric
  EXPECT_TRUE(both([](auto& c) { c.form.setZero(); }));
  EXPECT_TRUE(both([](auto& c) { c.parameters.gravity = 0.1; }));
  EXPECT_TRUE(both([](auto& c) { c.parameters.balls = 3; }));
  EXPECT_TRUE(refuted(attracting, [](auto& c) { c.speed = 1.2; }));
}

TEST(MemberCertificate, OfAStudyIsWrittenAndReadBack) {
  const std::string text =
      "[rotor]\neccentricity = 0.01\ndamping = 0.5\n[balancer]\nballs = 4\nmass = 0.05\ndrag = 0.05\n"
      "[speed]\nprofile = \"constant\"\nspeed = 2.4\n";
  const CertifyResult result = certify(parse_study(text, "study"));
  EXPECT_TRUE(result.proved());
  EXPECT_EQ(result.attracting() + result.unstable(), 64);
  // About half of this continuum attracts (docs/explanation/classification.md: 50 % of 1024 members); 64 members show
  // that to 6 %.
  EXPECT_NEAR(result.attracting(), 32, 13);
  EXPECT_NE(certify_text(result).find("nothing is proved of members that were not drawn"), std::string::npos);
  std::vector<MemberCertificate> members;
  for (const MemberProof& m : result.members) members.push_back(m.certificate);
  const std::string file = certificates_json(Certificates{{}, members});
  const Certificates read = certificates_from_json(file, "file");
  EXPECT_TRUE(read.states.empty());
  EXPECT_EQ(certificates_json(read), file);
  for (const MemberCertificate& m : read.members) EXPECT_TRUE(check_member(m).proved);
  const CertifyResult three = certify(parse_study(text, "study", {"balancer.balls=3"}));
  EXPECT_FALSE(three.proved());
  EXPECT_EQ(three.unstable(), 64);
  EXPECT_NE(three.note.find("no member"), std::string::npos);
  EXPECT_NE(certify(parse_study(text, "study", {"balancer.balls=2", "rotor.eccentricity=0.0"})).note.find("continuum"),
            std::string::npos);
}

}  // namespace member_certificate_test
