// Sentences about sweeps, capacities and slices, and plots as drawings, from results made by hand.
#include <gtest/gtest.h>

#include <stdexcept>

#include "../support/studies.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {
namespace cell_answer_test {

const std::string drawn_rotor = with(with(constant_speed, "= 0.01", "= { uniform = [0.005, 0.015] }"), "drag = 0.05",
                                     "drag = { values = [0.04, 0.06] }");

SweepAxis speeds(const std::vector<std::string>& given) {
  SweepParameter p{"speed.final", "", {}, given};
  for (const std::string& value : given) p.values.push_back(std::stod(value));
  return {{p}};
}

std::shared_ptr<SweepCell> cell_of(std::uint64_t balanced, std::uint64_t undecided = 0) {
  auto cell = std::make_shared<SweepCell>();
  cell->starts = 100;
  SweepOutcome o;
  o.id = balanced_id;
  o.name = "balanced";
  o.share = open_share(balanced, balanced + undecided, 100);
  cell->outcomes.push_back(o);
  cell->undecided = wilson_share(undecided, 100);
  cell->diverged = cell->failed = wilson_share(0, 100);
  return cell;
}

SweepResult sweep_of(const std::string& study, const std::vector<std::shared_ptr<SweepCell>>& cells) {
  SweepResult r;
  r.study = parse_study(study, "s.toml");
  std::vector<std::string> given;
  for (std::size_t k = 0; k < cells.size(); ++k) given.push_back(std::to_string(k + 2));
  r.axes = {speeds(given)};
  r.cells = cells;
  return r;
}

// Wilson's intervals of 60 in 100 are 50.2 to 69.1 %, of 20 in 100 13.3 to 28.9 %.
TEST(SweepAnswer, SaysWhereItBalancesMostAndLeast) {
  SweepResult r = sweep_of(constant_speed, {cell_of(60), cell_of(20), cell_of(40)});
  EXPECT_EQ(answer_sentence(r),
            "The rotor ends balanced most often at final speed 2 ω_c: in 50.2 to 69.1 % of starts; least often at "
            "final speed 3 ω_c: in 13.3 to 28.9 % (95 % confidence in each cell).");
  r.cells[2] = cell_of(60, 5);
  EXPECT_TRUE(holds(answer_sentence(r), "most often in 2 of 3 cells, such as final speed ")) << answer_sentence(r);
  EXPECT_TRUE(holds(answer_sentence(r), "; up to 5.0 % stay undecided, at final speed 4 ω_c.")) << answer_sentence(r);
  r.cells[1] = nullptr;
  EXPECT_TRUE(holds(answer_sentence(r), "In each of 2 cells the rotor ends balanced in 50.2 to 69.1 %"));
  r.cells[2] = nullptr;
  EXPECT_TRUE(holds(answer_sentence(r), "At final speed 2 ω_c the rotor ends balanced in 50.2 to 69.1 %"));
  r.cells[0] = nullptr;
  EXPECT_TRUE(holds(answer_sentence(r), "Nothing is known"));
}

// Where limits are stated, by the starts that keep them all; not so if one cell does not tell.
TEST(SweepAnswer, ComparesCellsByTheLimitsThatStartsKeep) {
  SweepResult r = sweep_of(constant_speed, {cell_of(60), cell_of(20)});
  const auto keep = [&](std::size_t cell, std::uint64_t starts, Within when = Within::both) {
    auto group = std::make_shared<TransientGroup>();
    group->within[static_cast<std::size_t>(when)] = wilson_share(starts, 100);
    r.cells[cell]->transients = group;
  };
  keep(0, 20);
  EXPECT_TRUE(holds(answer_sentence(r), "The rotor ends balanced most often at final speed 2 ω_c"))
      << answer_sentence(r);
  EXPECT_TRUE(holds(result_text(r), "20.0 % (13.3 to 28.9)                      -")) << result_text(r);
  keep(1, 60);
  EXPECT_EQ(answer_sentence(r),
            "Every limit is kept most often at final speed 3 ω_c: in 50.2 to 69.1 % of starts; least often at final "
            "speed 2 ω_c: in 13.3 to 28.9 % (95 % confidence in each cell).");
  EXPECT_TRUE(holds(result_text(r), "answer   Every limit is kept most often")) << result_text(r);
  EXPECT_TRUE(holds(result_text(r), "keep all limits"));
  for (const Within one_kind : {Within::at_end, Within::on_the_way}) {
    keep(0, 20, one_kind);
    keep(1, 60, one_kind);
    EXPECT_TRUE(holds(answer_sentence(r), "Every limit is kept most often at final speed 3 ω_c"));
    EXPECT_TRUE(holds(result_text(r), "keep all limits"));
  }
}

TEST(SweepAnswer, BeginsWithWhatIsDrawnUnlessItIsVaried) {
  SweepResult r = sweep_of(drawn_rotor, {cell_of(60)});
  EXPECT_TRUE(answer_sentence(r).starts_with(
      "With ball drag and eccentricity sampled for each run, at final speed 2 ω_c the rotor"))
      << answer_sentence(r);
  r.axes.front().parameters.front().key = "balancer.drag";
  EXPECT_TRUE(answer_sentence(r).starts_with("With eccentricity sampled for each run, at ball drag 2"));
}

TEST(KeyWords, ArePlain) {
  EXPECT_EQ(key_words("rotor.damping"), "rotor damping");
  EXPECT_EQ(key_words("initial.phi_dot_2"), "initial rate of ball 2");
  EXPECT_EQ(key_words("initial.phi_2"), "initial angle of ball 2");
  EXPECT_EQ(value_words("speed.speed", "2.4"), "2.4 ω_c");
  EXPECT_EQ(value_words("speed.final", "900 rpm"), "900 rpm");
}

TEST(SweepLayers, AreOfAllCellsInOrder) {
  auto with_two = cell_of(60, 5);
  SweepOutcome other;
  other.id = 9;
  other.name = "locked";
  other.share = wilson_share(35, 100);
  with_two->outcomes.push_back(other);
  const auto layers = sweep_layers(sweep_of(constant_speed, {cell_of(100), nullptr, with_two}));
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0].share, (std::vector<double>{1.0, 0.0, 0.6}));
  EXPECT_EQ(layers[1].name, "locked");
  EXPECT_EQ(layers[1].share, (std::vector<double>{0.0, 0.0, 0.35}));
  EXPECT_EQ(layers[2].name, "undecided");
  EXPECT_EQ(layers[2].colour, colour_of(undecided_code));
}

CapacityResult capacity_of(const std::vector<CapacityCell>& cells) {
  CapacityResult r;
  r.study = parse_study(constant_machine, "m.toml");
  r.key = "rotor.unbalance";
  r.unit = "g mm";
  r.from = 20.0;
  r.to = 400.0;
  std::vector<std::string> given;
  for (std::size_t k = 0; k < cells.size(); ++k) given.push_back(std::to_string(k + 2));
  if (cells.size() > 1) r.axes = {speeds(given)};
  r.cells.assign(cells.begin(), cells.end());
  r.open.resize(cells.size());
  return r;
}

CapacityTrial trial(double value, std::uint64_t kept) { return {value, wilson_share(kept, 1000), {}, false, {}}; }

TEST(CapacityAnswer, TellsTheBoundaryOrWhatLiesBeyond) {
  const CapacityCell inside{{trial(201.0, 1000), trial(220.0, 0)}, 213.2, 201.0, 220.0, false, false};
  const CapacityCell always{{trial(400.0, 1000)}, {}, 400.0, 400.0, true, false},
      never{{trial(20.0, 0)}, {}, 20.0, 20.0, false, true};
  EXPECT_EQ(answer_sentence(capacity_of({inside})),
            "Up to unbalance 213.2 g mm, 95 % of starts end balanced: shown up to 201, shown to be fewer from 220 on "
            "(95 % confidence).");
  EXPECT_TRUE(holds(answer_sentence(capacity_of({always})),
                    "Up to unbalance 400 g mm, the end of the range, 95 % of starts end balanced"));
  EXPECT_TRUE(
      holds(answer_sentence(capacity_of({never})), "At unbalance 20 g mm, where the range begins, fewer than "));
  CapacityResult by_limits = capacity_of({inside});
  by_limits.by = "limits";
  EXPECT_TRUE(holds(answer_sentence(by_limits), "95 % of starts keep every limit: shown up to 201"));
  // The share that is tabled and drawn is that of starts that keep the limits: those that balance are not counted.
  const std::string page = document_text(document_of(by_limits));
  EXPECT_TRUE(holds(page, "keep every limit  95 % interval"));
  EXPECT_FALSE(holds(page, "balanced"));
  EXPECT_EQ(answer_sentence(capacity_of({inside, never, always})),
            "The largest unbalance at which 95 % of starts end balanced is more than 400 g mm at final speed 4 ω_c; it "
            "is least at final speed 3 ω_c: less than 20 g mm (95 % confidence).");
}

// The share is near 95 % at both ends.
TEST(CapacityAnswer, DoesNotSayShownOfWhatNoTrialShows) {
  const CapacityCell vague{{trial(20.0, 960), trial(400.0, 940)}, 213.2, 20.0, 400.0, false, false},
      likely{{trial(20.0, 940)}, {}, 20.0, 400.0, false, true},
      inside{{trial(201.0, 1000), trial(220.0, 0)}, 213.2, 201.0, 220.0, false, false};
  EXPECT_EQ(answer_sentence(capacity_of({vague})),
            "Up to unbalance 213.2 g mm, 95 % of starts end balanced: likely, but not shown.");
  EXPECT_TRUE(holds(answer_sentence(capacity_of({likely})), "95 % of starts end balanced: likely, but not shown."));
  EXPECT_TRUE(holds(answer_sentence(capacity_of({inside, likely})), "likely less than 20 g mm"));
}

// Stopped before a cell is finished.
TEST(CapacityAnswer, SaysWhatTheFirstTrialsShow) {
  CapacityResult r = capacity_of({{}});
  r.cells.front().reset();
  EXPECT_EQ(answer_sentence(r), "Nothing is known: no cell is done.");
  r.trials = 8;
  EXPECT_EQ(answer_sentence(r), "Nothing is known yet: 8 values tried, none with 95 % confidence.");
  r.open.front() = OpenCapacity{201.0, {}, 1};
  EXPECT_EQ(answer_sentence(r),
            "Up to unbalance 201 g mm, 95 % of starts end balanced: shown up to 201 (95 % confidence); stopped before "
            "the largest was found.");
  r.open.front() = OpenCapacity{{}, 220.0, 1};
  EXPECT_TRUE(holds(answer_sentence(r), "From unbalance 220 g mm on, fewer than 95 % of starts end balanced"));
}

TEST(CapacityTable, TellsOnlyEndsThatATrialShows) {
  const auto row = [](const CapacityCell& cell) {
    const DocumentTable table = capacity_table(capacity_of({cell}));
    return table.rows.at(0).at(0).text + " | " + table.rows.at(0).at(1).text;
  };
  EXPECT_EQ(row({{trial(20.0, 0)}, {}, 20.0, 20.0, false, true}), "below 20 | ? and 20");
  EXPECT_EQ(row({{trial(400.0, 1000)}, {}, 400.0, 400.0, true, false}), "above 400 | 400 and ?");
  EXPECT_EQ(row({{trial(201.0, 1000), trial(220.0, 0)}, 213.2, 201.0, 220.0, false, false}), "213.2 | 201 and 220");
}

TEST(MapAnswer, TellsThePartThatBalances) {
  BasinSlice map;
  map.study = parse_study(constant_speed, "c.toml");
  map.x.key = "initial.phi_1";
  map.y.key = "initial.phi_2";
  EXPECT_TRUE(holds(answer_sentence(map), "Nothing is known"));
  map.codes = {{balanced_id, "balanced", "", wilson_share(60, 100)},
               {undecided_code, "undecided", "", wilson_share(2, 100)}};
  EXPECT_EQ(answer_sentence(map),
            "Of 100 points over initial angle of ball 1 and initial angle of ball 2, 50.2 to 69.1 % end balanced (95 % "
            "confidence, as of random "
            "ones); 2.0 % stay undecided.");
  map.codes.front().share = wilson_share(0, 100);
  EXPECT_TRUE(holds(answer_sentence(map), "Not one of 100 points over"));
}

TEST(PlotSvg, DrawsIntervalsAndNamesSeries) {
  Plot plot{"", "x <", "y", false, false, true, {}};
  plot.series.push_back({"one", "#0072B2", PlotSeries::Style::line, {1.0, 2.0}, {3.0, 4.0}, {2.0, 3.5}, {4.0, 4.5}});
  const std::string svg = plot_svg(plot, "what");
  for (const char* part : {"<title>what</title>", "x &lt;", ">one</text>", "#0072B2"})
    EXPECT_TRUE(holds(svg, part)) << part;
  EXPECT_FALSE(holds(svg, "nan"));
  EXPECT_FALSE(holds(plot_svg(Plot{}, "nothing"), "nan"));
  // One series below a title needs no legend; the curve says its name.
  plot.title = "one";
  const std::string titled = plot_svg(plot, "what");
  EXPECT_FALSE(holds(titled, ">one</text>"));
  EXPECT_TRUE(holds(titled, "<g><title>one</title>"));
  EXPECT_FALSE(holds(titled, "stroke-dasharray"));
  plot.series.push_back({"two", "#222222", PlotSeries::Style::dashed, {1.0, 2.0}, {3.0, 4.0}, {}, {}});
  const std::string both = plot_svg(plot, "what");
  for (const char* part : {">one</text>", ">two</text>", "<g><title>two</title>", "stroke-dasharray"})
    EXPECT_TRUE(holds(both, part)) << part;
}

// Where a plot's markers lie across.
std::vector<double> abscissae(const std::string& svg) {
  std::vector<double> all;
  for (std::size_t at = svg.find("<circle cx=\""); at != std::string::npos; at = svg.find("<circle cx=\"", at + 1))
    all.push_back(std::stod(svg.substr(at + 12)));
  return all;
}

TEST(PlotSvg, ALogarithmicAxisPutsDecadesAtEqualDistances) {
  Plot plot{"t", "T0", "y", true, false, false, {}};
  plot.series.push_back({"one", "#0072B2", PlotSeries::Style::line, {1e-6, 0.01, 100.0}, {1.0, 2.0, 3.0}, {}, {}});
  const std::string svg = plot_svg(plot, "what");
  for (const char* tick : {">10⁻⁶<", ">10⁻³<", ">0.01<", ">1<", ">100<"}) EXPECT_TRUE(holds(svg, tick)) << tick;
  const std::vector<double> x = abscissae(svg);
  ASSERT_EQ(x.size(), 3u);
  EXPECT_NEAR(x[2] - x[1], x[1] - x[0], 0.02);
  EXPECT_GT(x[1] - x[0], 100.0);
  plot.log_x = false;
  const std::vector<double> even = abscissae(plot_svg(plot, "what"));
  EXPECT_LT(even[1] - even[0], 1.0);  // 0.01 of 100
}

TEST(PlotSvg, CurvesFillTheFrameWithoutMarkers) {
  Plot plot{"t", "t", "r", false, true, true, {}};
  plot.series.push_back({"", "#0072B2", PlotSeries::Style::line, {0.0, 1.0, 2.0}, {1.0, 2.0, 3.0}, {}, {}});
  const std::string svg = plot_svg(plot, "what", 500.0);
  EXPECT_FALSE(holds(svg, "<circle"));
  EXPECT_TRUE(holds(svg, "d=\"M58.0 ")) << svg;
  EXPECT_TRUE(holds(svg, " 486.0 ")) << svg;  // 14 from the right
}

TEST(Raster, IsRefusedWhereItsPartsDoNotAgree) {
  EXPECT_EQ(png_bytes({1, 1, {"#ff0000"}, {0}}).substr(1, 3), "PNG");
  EXPECT_THROW(png_bytes({2, 1, {"#ff0000"}, {0}}), std::invalid_argument);
  EXPECT_THROW(png_bytes({1, 1, {"#ff0000"}, {1}}), std::invalid_argument);
  EXPECT_THROW(png_bytes({0, 0, {"#ff0000"}, {}}), std::invalid_argument);
}

TEST(HeatColour, GoesFromEndToEnd) {
  EXPECT_EQ(heat_colour(0.0), "#440154");
  EXPECT_EQ(heat_colour(1.0), "#fde725");
  EXPECT_EQ(heat_colour(0.5), "#21908d");
}

}  // namespace cell_answer_test
}  // namespace equipoise
