// Other publications: the table is whole, symbols mean what their mapping says, verdicts follow from both sides'
// errors, and the page in the documentation has them.
#include "equipoise/extras/publications/publication_verdicts.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace publications_test {

using namespace equipoise;

TEST(Publications, AreEachWhole) {
  std::set<std::string> names;
  for (const Publication& p : publications()) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_EQ(find_publication(p.name), &p);
    for (const char* text : {p.title, p.citation, p.seen}) EXPECT_GT(std::string(text).size(), 4u) << p.name;
    EXPECT_FALSE(p.symbols.empty()) << p.name;
    EXPECT_FALSE(p.rows.empty()) << p.name;
    for (const PublicationRow& row : p.rows) {
      const std::string where = std::string(p.name) + ", " + row.place + ": " + row.quantity;
      EXPECT_EQ(row.known_by == KnownBy::formula, row.formula != nullptr) << where;
      EXPECT_TRUE(row.formula || row.published.error > 0.0) << where;
      EXPECT_TRUE(row.computed || *row.reason) << where;
      if (row.computed) {
        EXPECT_NO_THROW(study_of(p, row)) << where;
      }
    }
  }
  EXPECT_EQ(find_publication("nobody-1900"), nullptr);
  EXPECT_THROW(judge_publications({"nobody-1900"}), InputError);
}

TEST(Publications, AreJudgedByBothSidesErrors) {
  PublicationRow row{"p. 1", "anything", ""};
  EXPECT_EQ(judged({1.0, 0.1}, {1.25, 0.16}, row), RowVerdict::agrees);
  EXPECT_EQ(judged({1.0, 0.1}, {1.25, 0.14}, row), RowVerdict::differs);
  EXPECT_EQ(judged({1.0, 0.1}, {0.75, 0.14}, row), RowVerdict::differs);
  row.reason = "known";
  EXPECT_EQ(judged({1.0, 0.1}, {0.75, 0.14}, row), RowVerdict::explained);
  EXPECT_EQ(judged({1.0, 0.1}, {1.05, 0.0}, row), RowVerdict::agrees);
}

TEST(Publications, TellADifferenceThatNobodyExplains) {
  const PublicationRow row{"p. 1", "anything", ""};
  const Publication p{"somebody-1900", "Somebody 1900", "a book", "all", "", {{"x", "y"}}, {}};
  JudgedPublications r;
  r.list.push_back({&p, {{&row, {1.0, 0.1}, {2.0, 0.1}, RowVerdict::differs}}});
  EXPECT_TRUE(r.differs());
  EXPECT_NE(publications_text(r).find("0 of 1 numbers agree, 1 differ, 0 of them"), std::string::npos);
  EXPECT_NE(publications_json(r).find("\"differs\": true"), std::string::npos);
  r.list.front().rows.front().verdict = RowVerdict::explained;
  EXPECT_FALSE(r.differs());
  EXPECT_NE(publications_text(r).find("1 differ, each for a reason that is known;"), std::string::npos);
}

// The rotor of Rodrigues and others (2008), section 2: four balls in two planes at +z and -z, with tilt; its equations
// in turning axes at constant speed, without couple unbalance. Both planes' balls start alike.
TEST(Publications, MapFourBallsInTwoPlanesOntoTwoOfTwiceTheMass) {
  const Publication& p = *find_publication("rodrigues-2008");
  const Study study = study_of(p, p.rows.front());
  constexpr double w = 2.0, lambda = 0.01, mu = 0.025, beta = 0.01, c11 = 0.02, c22 = 0.18, k22 = 9.0;  // m/M and so on
  constexpr double jt = 3.25, jp = 0.5;
  constexpr double z[] = {2.0, 2.0, -2.0, -2.0};
  ASSERT_EQ(study.parameters.mass[0], 2.0 * mu);
  ASSERT_EQ(study.parameters.eccentricity, lambda);
  ASSERT_EQ(study.parameters.damping[0], c11);
  ASSERT_EQ(study.parameters.drag[0], beta);
  ASSERT_EQ(study.speed.speed, w);
  using State = Eigen::Matrix<double, 16, 1>;  // centre, slope, their inertial velocities; angles, rates
  const auto flow = [&](const State& s) {
    Eigen::Matrix4d mass = Eigen::Vector4d(1.0, 1.0, jt, jt).asDiagonal();
    Eigen::Vector4d force(lambda * w * w - c11 * s[4] - s[0], -c11 * s[5] - s[1],
                          -w * jp * s[7] - c22 * s[6] - k22 * s[2], w * jp * s[6] - c22 * s[7] - k22 * s[3]);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d e(std::cos(s[8 + i]), std::sin(s[8 + i])), t(-e[1], e[0]);
      const double q = s[12 + i];
      const Eigen::Matrix2d radial = mu * e * e.transpose();
      mass.topLeftCorner<2, 2>() += radial;
      mass.topRightCorner<2, 2>() += z[i] * radial;
      mass.bottomLeftCorner<2, 2>() += z[i] * radial;
      mass.bottomRightCorner<2, 2>() += z[i] * z[i] * radial;
      const Eigen::Vector2d pull = mu * ((w + q) * (w + q) * e + beta * q * t);
      force.head<2>() += pull;
      force.tail<2>() += z[i] * pull;
    }
    const Eigen::Vector4d a = mass.partialPivLu().solve(force);
    State d;
    for (int k = 0; k < 4; k += 2) {
      d[k] = s[4 + k] + w * s[k + 1];
      d[k + 1] = s[5 + k] - w * s[k];
      d[4 + k] = a[k] + w * s[5 + k];
      d[5 + k] = a[k + 1] - w * s[4 + k];
    }
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d t(-std::sin(s[8 + i]), std::cos(s[8 + i]));
      d[8 + i] = s[12 + i];
      d[12 + i] = -beta * s[12 + i] - t.dot(a.head<2>() + z[i] * a.tail<2>());
    }
    return d;
  };
  State s = State::Zero();
  for (int i = 0; i < 4; ++i) s[8 + i] = study.initial.phi[static_cast<std::size_t>(i % 2)];
  constexpr double h = 1e-3;
  for (int k = 0; k < 20000; ++k) {
    const State a = flow(s), b = flow(s + 0.5 * h * a), c = flow(s + 0.5 * h * b), d = flow(s + h * c);
    s += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  const Trajectory ours = simulate(study, {20.0});
  EXPECT_NEAR(ours.radial.back(), std::hypot(s[0], s[1]), 1e-10);
  EXPECT_NEAR(ours.phi[0].back(), s[8], 1e-9);
  EXPECT_NEAR(ours.phi[1].back(), s[11], 1e-9);
  EXPECT_LT(std::hypot(s[2], s[3]), 1e-10);  // no tilt
}

// By other programs, of the same equations: DOP853 of SciPy at 1e-10, eigenvalues, a Magnus series over half a turn,
// Newton's method on the period.
TEST(Publications, OfRotorsThatTiltHaveTheNumbersOfOtherPrograms) {
  struct Number {
    const char *publication, *place;
    int which;  // of the rows of this place
    double value, within;
  };
  constexpr Number numbers[] = {
      {"rodrigues-2008", "(22)", 1, 0.00261500, 5e-9},
      {"rodrigues-2008", "fig. 12 (a)", 1, 0.008371, 5e-7},
      {"rodrigues-2008", "fig. 5 (a)", 0, 2.1190642, 5e-8},
      {"rodrigues-2008", "fig. 5 (a)", 1, 2.3259175, 5e-8},
      {"rodrigues-2008", "fig. 5 (a)", 2, 5.2624785, 5e-8},
      {"rodrigues-2008", "fig. 5 (d)", 0, 4.136987, 1e-5},
      {"rodrigues-2008", "fig. 5 (e)", 0, 0.0033563604, 1e-10},
      {"rodrigues-2008", "fig. 5 (e)", 1, 0.0037939314, 1e-10},
      {"rodrigues-2008", "fig. 5 (e)", 2, 0.0054437753, 1e-10},
      {"rodrigues-2008", "fig. 6 (a)", 0, 0.050784091, 1e-9},
      {"rodrigues-2008", "fig. 6 (b)", 0, 0.0327483, 5e-8},
      {"rodrigues-2008", "fig. 6 (b)", 1, 0.1202112, 5e-8},
      {"rodrigues-2008", "fig. 6 (b)", 2, 0.3551976, 5e-8},
      {"rodrigues-2008", "fig. 6 (c)", 0, 3.9901700, 5e-8},
      {"rodrigues-2008", "fig. 10 (b)", 0, 3.7409628, 5e-8},
      {"rodrigues-enoc", "(7)", 2, 1.65923, 5e-6},
      {"rodrigues-enoc", "(7)", 3, 3.77692, 5e-6},
      {"rodrigues-enoc", "fig. 3 (b)", 0, 1.02e-4, 5e-7},
      {"rodrigues-enoc", "fig. 3 (b)", 1, 5.2e-6, 5e-8},
      {"rodrigues-enoc", "fig. 3 (b)", 2, 3.3e-6, 5e-8},
      {"rodrigues-enoc", "fig. 3 (b)", 3, 1.63e-3, 5e-6},
      {"rodrigues-enoc", "fig. 3 (b)", 4, 4.03e-3, 5e-6},
      {"rodrigues-enoc", "fig. 3 (b)", 5, 3.3e-5, 5e-7},
      {"rodrigues-enoc", "fig. 3 (b)", 6, 1.1e-5, 5e-7},
      {"rodrigues-virm", "fig. 5", 0, 3.390e-4, 5e-7},
      {"rodrigues-virm", "fig. 5", 1, 2.348e-4, 5e-7},
      {"rodrigues-virm", "fig. 5", 2, -2.444, 2e-3},
      {"rodrigues-2010", "fig. 8", 4, 0.03482, 5e-6},
      {"rodrigues-2010", "fig. 13", 0, 0.1083, 5e-5},
      {"rodrigues-2011", "fig. 11", 0, 2.481824, 5e-7},
      {"rodrigues-2011", "fig. 11", 1, 2.669680, 5e-7},
      {"rodrigues-2011", "fig. 11", 2, 4.506006, 5e-7},
      {"rodrigues-2011", "fig. 12 (b)", 0, 3.3e-5, 5e-7},
      {"rodrigues-2011", "fig. 12 (b)", 1, 4.4e-4, 5e-6},
      {"rodrigues-2011", "fig. 12 (b)", 2, 1.11e-3, 5e-6},
      {"rodrigues-2011", "fig. 12 (b)", 3, 1.46e-3, 5e-6},
      {"rodrigues-2011", "fig. 12 (b)", 4, 3.23e-3, 4e-5},  // it falls there: t = 700 counts
      {"rodrigues-2011", "fig. 12 (b)", 5, 1.2e-5, 5e-7},
      {"rodrigues-2011", "fig. 13 (a)", 0, 0.059182837, 1e-9},
      {"rodrigues-2011", "fig. 13 (d)", 0, 0.037696980, 1e-9},
      {"rodrigues-2011", "fig. 14 (c)", 0, 3.3869559, 5e-8},
      {"rodrigues-2011", "fig. 14 (d)", 0, 7.078187, 5e-7},
      {"rodrigues-2011", "fig. 14 (d)", 1, 9.85413, 5e-6},
      {"rodrigues-2011", "fig. 16", 0, 5.611e-4, 5e-7},
      {"rodrigues-2011", "fig. 16", 1, 7.919e-4, 5e-7},
      {"rodrigues-2011", "fig. 16", 2, -1.077, 1e-3},
      {"rodrigues-2011", "fig. 16", 3, 1.508e-3, 1e-6},
  };
  for (const Number& number : numbers) {
    const Publication& p = *find_publication(number.publication);
    int seen = 0;
    for (const PublicationRow& row : p.rows) {
      if (std::string(row.place) != number.place || seen++ != number.which) continue;
      EXPECT_NEAR(row.computed(study_of(p, row), {}).value, number.value, number.within)
          << p.name << ", " << row.quantity;
    }
    EXPECT_GT(seen, number.which) << p.name << ", " << number.place;
  }
}

std::string text_of(const std::string& path) {
  std::ifstream file(std::string(EQUIPOISE_SOURCE_DIR) + "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Without the column of numbers of this program, whose last digits belong to a processor.
std::string without_ours(const std::string& markdown) {
  std::istringstream lines(markdown);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
    if (cells.size() == 8) cells[6].clear();
    for (const std::string& cell : cells) kept += cell + "|";
    kept += "\n";
  }
  return kept;
}

TEST(Publications, StandInTheDocumentationWithTheseVerdicts) {
  std::vector<std::string> names;
  for (const Publication& p : publications()) names.emplace_back(p.name);
  JudgedPublications r = judge_publications(names);
  r.command = "equipoise reproduce publications --report publications.md";
  EXPECT_FALSE(r.differs());
  EXPECT_EQ(without_ours(document_markdown(publications_document(r), "")),
            without_ours(text_of("docs/evidence/publications.md")));
}

}  // namespace publications_test
