// The verdict, then words and tables around the drawings: what the machine does, its transients, its data, and how they
// were computed.
#include "equipoise/report/html/machine_html.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "equipoise/report/decision/plain_names.hpp"
#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/answers/sampling_text.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/reports/transient_report.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// Replaces the terminal's line ends by spaces.
std::string on_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

class MachineDocument {
 public:
  MachineDocument(const MachinePage& page, std::span<const TriedChange> tried)
      : page_(page),
        tried_(tried),
        basin_(page.basin),
        study_(page.basin.study),
        physical_(study_.scales.has_value()),
        shown_(page.basin.study) {}

  Document make() {
    document_ = document_with(study_, answer_sentence(basin_), "", verdict());
    if (basin_.partial) add(Paragraph{"Stopped early: all figures are of the starts that were done.", Tone::bad});
    if (!basin_.note.empty() && study_.parameters.balls > 0)
      add(Paragraph{"Note: " + note_text(study_, basin_.note) + ".", Tone::open});
    changes();
    run_up();
    if (study_.parameters.balls == 0 && basin_.without_balls) {
      add(Heading{2, "The rotor alone", ""});
      add(bare_table(basin_));
      std::string words = bare_words(basin_);
      for (const std::string& sentence : without_balls_words(basin_)) words += " " + sentence;
      add(Paragraph{on_one_line(words)});
      kept();
    }
    if (basin_.starts > 0) {
      kept();
      ends();
      way();
    }
    origin();
    return std::move(document_);
  }

 private:
  void add(Block block) { document_.blocks.push_back(std::move(block)); }

  std::optional<Notice> verdict() const {
    const auto verdict = verdict_of(basin_, tried_);
    if (!verdict) return std::nullopt;
    return Notice{
        verdict->words, tone_of(verdict->decision), {{"because", verdict->because}, {"change", verdict->change}}};
  }

  void changes() {
    DocumentTable table = changes_table(basin_, tried_);
    if (table.rows.empty()) return;
    add(Heading{2, "What to change", ""});
    add(std::move(table));
  }

  // The page's main picture.
  void run_up() {
    if (page_.runs.empty()) return;
    const bool constant = study_.speed.profile == Profile::constant;
    add(Heading{2, constant ? "How it shakes" : "How it shakes on its way up", ""});
    DrawingRow row;
    row.whole = true;
    row.drawings.push_back({"", run_up_svg(page_), "", ""});
    row.caption = runs_caption();
    add(std::move(row));
  }

  const TransientGroup* group(const OutcomeShare& o) const {
    if (!basin_.transients) return nullptr;
    for (const TransientGroup& g : basin_.transients->groups)
      if (g.starts > 0 && g.id == o.id) return &g;
    return nullptr;
  }

  // Limits and standards.
  void kept() {
    std::vector<Block> blocks;
    if (basin_.transients && !basin_.transients->groups.empty() && basin_.transients->groups.front().starts > 0) {
      const TransientGroup& all = basin_.transients->groups.front();
      if (DocumentTable limits = limits_table(all, study_); !limits.rows.empty()) blocks.push_back(std::move(limits));
      if (const std::string words = clearance_words(all, study_); !words.empty())
        blocks.push_back(Paragraph{on_one_line(words)});
    }
    const bool limited = !blocks.empty();
    std::vector<Block> standards = standards_blocks(basin_);
    if (!limited && standards.empty()) return;
    add(Heading{2, !limited ? "Standards" : standards.empty() ? "Limits" : "Limits and standards", ""});
    for (std::vector<Block>* of : {&blocks, &standards})
      for (Block& block : *of) add(std::move(block));
  }

  // Where starts end, and how large peaks are on the way there.
  void ends() {
    add(Heading{2, "Where starts end", ""});
    DrawingRow row;
    row.drawings.push_back({"", shares_svg(page_), "", ""});
    for (const DrawnMotion& motion : page_.motions)
      if (!motion.x.empty())
        row.drawings.push_back(
            {reader_title(motion, physical_), motion_svg(page_, motion), motion_words(motion), colour_of(motion.id)});
    for (const FigureDistribution& d : page_.peaks)
      row.drawings.push_back({capital(d.limited->figure().title) + ", all starts", distribution_svg(page_, d), "", ""});
    if (!page_.runs.empty() && !run_up_tells_speed(page_))
      row.drawings.push_back({"Speed over time", speed_svg(page_), "", ""});
    row.caption =
        study_.parameters.tilts()
            ? fmt::format(
                  "Bars: shares of starts with 95 % intervals. Circles: left, the balls in their races as seen from "
                  "the turning rotor, that with the largest place along the shaft outermost, with arrows where balls "
                  "move; right, the path of the shaft {}, as seen from beside the machine, all to one scale",
                  study_.bearings.empty() ? "at the centre of mass" : "at the outermost bearing that moves more")
            : "Bars: shares of starts with 95 % intervals. Circles: left, the balls in the race as seen from the "
              "turning rotor, with a wedge at its heavy side and arrows where balls move; right, the path of the "
              "rotor's centre as seen from beside the machine, all to one scale";
    row.caption += study_.limits.displacement ? ", the limit dashed if it lies within the drawing." : ".";
    if (page_.motions_left_out > 0) row.caption += fmt::format(" {} rarer not drawn.", page_.motions_left_out);
    if (page_.starts_drawn < basin_.starts)
      row.caption += fmt::format(" Peaks and runs are of the first {} starts.", page_.starts_drawn);
    add(std::move(row));
    add(ends_table());
    if (const std::string left = left_unbalance_text(basin_.attractors, study_); !left.empty())
      add(Paragraph{on_one_line(left)});
  }

  std::string motion_words(const DrawnMotion& m) const {
    const bool rests = m.r_max < 1e-9;
    std::string text = rests ? "The centre rests on the axis" : "The centre is ";
    if (m.bearing)
      text = fmt::format(fmt::runtime(rests ? "At {} the shaft rests on the axis" : "At {} the shaft is "),
                         shown_.text(*m.bearing, Dimension::length));
    if (!rests) text += shown_.range(m.r_min, m.r_max, Dimension::length) + " off the axis";
    if (study_.speed.driven()) text += fmt::format(" at {}", shown_.text(m.speed, Dimension::speed));
    text += "; " + ball_words(m);
    text += ".";
    if (m.one_start) text += " Drawn from the end of one start.";
    if (m.continuum) text += " One of a continuum of such motions.";
    return text;
  }

  // "the balls rest in the race"; "ball 1 rests, ball 2 falls behind by 0.9 ω_c".
  std::string ball_words(const DrawnMotion& m) const {
    constexpr double still = 0.01;  // rad: in a race of 0.1 m they move by a millimetre
    std::vector<std::string> does;
    for (const BallOnMotion& b : m.balls) {
      const bool behind = b.drift * (m.speed < 0.0 ? -1.0 : 1.0) < 0.0;
      does.push_back(b.drift != 0.0           ? fmt::format("{} by {}", behind ? "behind" : "ahead",
                                                            shown_.text(std::fabs(b.drift), Dimension::speed))
                     : b.high - b.low < still ? "rest"
                                              : "swing");
    }
    const auto words = [](const std::string& what, bool one) {
      if (what == "rest") return std::string(one ? "rests in the race" : "rest in the race");
      if (what == "swing") return std::string(one ? "swings about its place" : "swing about their places");
      return (what.starts_with("behind") ? one ? "falls " : "fall " : one ? "runs " : "run ") + what;
    };
    if (std::all_of(does.begin(), does.end(), [&](const std::string& one) { return one == does.front(); }))
      return does.size() == 1 ? "the ball " + words(does[0], true) : "the balls " + words(does[0], false);
    std::string text;
    for (std::size_t i = 0; i < does.size(); ++i)
      text += fmt::format("{}ball {} {}", i ? ", " : "", i + 1, words(does[i], true));
    return text;
  }

  DocumentTable ends_table() const {
    const bool open = basin_.undecided.count > 0, graded = is_graded(study_);
    DocumentTable table;
    table.header = {physical_ ? "what the balls do" : "outcome", "share", "95 % interval"};
    if (open) table.header.push_back("bounds");
    table.header.insert(table.header.end(), {"starts", "displacement", "RMS velocity"});
    if (graded) table.header.push_back("balance quality");
    table.spare = {open ? 4u : 3u, open ? 6u : 5u};
    for (const OutcomeShare& o : basin_.outcomes_met()) {
      const Share& s = o.share;
      const TransientGroup* of = group(o);
      std::vector<DocumentCell> cells{{reader_title(o, physical_)}, share_cell(s), number_cell(interval(s))};
      if (open) cells.push_back(number_cell(o.id == undecided_code ? "-" : bounds_text(s)));
      cells.push_back(number_cell(fmt::format("{}", s.count)));
      const auto mean = [&](float TransientRow::*value, Dimension d) {
        return number_cell(of ? shown_.text(of->figure(value).mean, d) : "-");
      };
      cells.push_back(mean(&TransientRow::peak_radial_at_end, Dimension::length));
      cells.push_back(mean(&TransientRow::rms_velocity, Dimension::velocity));
      if (graded) {
        const auto grade = of ? left_grade(*of, study_) : std::nullopt;
        cells.push_back(number_cell(grade ? grade_text(*grade) : "-"));
      }
      table.rows.push_back(std::move(cells));
    }
    table.caption = "Displacement and velocity at the end, means over the starts of the outcome";
    if (graded)
      table.caption +=
          study_.parameters.tilts()
              ? "; balance quality: ISO 21940-11's grade of the unbalance that is left in the plane of the outermost "
                "bearing that has more of it for its share, for comparison only"
              : "; balance quality: ISO 21940-11's grade of the unbalance that is left, for comparison only";
    table.caption += ".";
    return table;
  }

  // Transients on the way there.
  void way() {
    if (!basin_.transients || basin_.transients->groups.empty() || basin_.transients->groups.front().starts == 0)
      return;
    add(Heading{2, "On the way", ""});
    const TransientGroup& all = basin_.transients->groups.front();
    add(way_table(all));
    std::string words;
    if (tells_without_balls(basin_))
      for (const std::string& sentence : without_balls_words(basin_)) words += sentence + " ";
    if (!words.empty()) add(Paragraph{on_one_line(words)});
  }

  static std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
  }

  std::string runs_caption() const {
    std::string text =
        study_.bearings.empty()
            ? "Distance of the rotor's centre from its place at rest; shaded: swings too fast to be drawn."
            : "Distance of the shaft from its place at rest, at the bearing where it is largest; shaded: swings too "
              "fast to be drawn.";
    std::string numbers;
    for (const ShownRun& run : page_.runs) {
      if (run.of == RunOf::bare) {
        if (!study_.uncertain.empty() && page_.runs.size() > 1)
          text += " Without balls: the rotor of the typical start.";
        continue;
      }
      numbers += fmt::format("{}start {} is the {}", numbers.empty() ? "" : ", ", run.index,
                             run.of == RunOf::median ? "typical one" : "worst in a hundred");
      // Starts near the boundary of two basins may go another way if the last digit differs.
      constexpr double alike = 0.02;
      if (std::fabs(run.again - run.peak) > alike * run.peak)
        numbers += fmt::format(" (followed again with smaller steps, {} within what is shown)",
                               shown_.text(run.again, Dimension::length));
    }
    return numbers.empty() ? text : fmt::format("{} With this seed, {}.", text, numbers);
  }

  DocumentTable way_table(const TransientGroup& all) const {
    const Limits& limits = study_.limits;
    const bool limited = std::any_of(transient_limits.begin(), transient_limits.end(), [&](const TransientLimit& l) {
      return l.figure().on_page && !l.by_speed && limits.*l.limit;
    });
    const bool beside = tells_without_balls(basin_);
    DocumentTable table{{"all starts", "median", "90 % below", "99 % below"}, {}, "", false, {2}};
    if (beside) table.header.emplace_back("no balls");
    if (limited) {
      table.header.insert(table.header.end(), {"limit", "exceeded by"});
      table.spare.push_back(beside ? 5 : 4);
    }
    for (std::size_t k = 0; k < transient_figures.size(); ++k) {
      const TransientFigure& f = transient_figures[k];
      const SampleSummary& s = all.figures[k];
      if (!f.on_page || !basin_.transients->asks(f, limits)) continue;
      const char* open = !f.needs ? "" : f.open[all.for_good(f) > 0 ? 0 : 1];
      const auto figure = [&](double v) { return number_cell(std::isfinite(v) ? shown_.text(v, *f.dimension) : open); };
      table.rows.push_back({{f.title, Tone::plain, false, true},
                            figure(s.quantiles[0].value),
                            figure(s.quantiles[1].value),
                            figure(s.quantiles[2].value)});
      if (beside) table.rows.back().push_back(without_balls(k));
      if (!limited) continue;
      DocumentCell limit = number_cell("-"), exceeded = number_cell("-");
      for (std::size_t l = 0; l < transient_limits.size(); ++l) {
        const auto& stated = limits.*transient_limits[l].limit;
        if (transient_limits[l].value != f.value || transient_limits[l].by_speed || !stated) continue;
        limit = number_cell(shown_.text(*stated, transient_limits[l].told_in()));
        if (all.exceeded[l]) exceeded = number_cell(share_words(*all.exceeded[l]));
        break;
      }
      table.rows.back().insert(table.rows.back().end(), {limit, exceeded});
    }
    if (beside)
      table.caption = basin_.without_balls->bare.one ? "No balls: one run of the same rotor. "
                                                     : "No balls: median of the first starts' rotors. ";
    if (limits.settled)
      table.caption += fmt::format("Settled: displacement below {}.", shown_.text(*limits.settled, Dimension::length));
    if (page_.explanation.sag > 0.0)
      table.caption += fmt::format(
          " Displacements are measured from where the rotor rests, {} below its unloaded springs; forces include its "
          "weight.",
          shown_.text(page_.explanation.sag, Dimension::length));
    return table;
  }

  // A figure of the rotor without balls; in the median, if starts differ in it.
  DocumentCell without_balls(std::size_t k) const {
    const TransientFigure& f = transient_figures[k];
    const SampleSummary& s = basin_.without_balls->bare.figures.figures[k];
    if (!f.of_bare_rotor || s.count == 0) return number_cell("-");
    const double value = s.quantiles[0].value;
    const bool for_good = basin_.without_balls->bare.figures.for_good(f) > 0;
    return number_cell(std::isfinite(value) ? shown_.text(value, *f.dimension) : f.open[for_good ? 0 : 1]);
  }

  // How that is known.
  void origin() {
    std::string text =
        study_.parameters.balls == 0
            ? std::string()
            : fmt::format("{} starts {}, each followed until it is known where it ends (undecided after {}). ",
                          basin_.starts, starts_words(study_, drawn_keys(study_)),
                          shown_.text(study_.numerics.horizon.value_or(0.0), Dimension::time));
    if (study_.parameters.balls > 0) text += on_one_line(sampling_text(basin_));
    if (basin_.resumed_from > 0) text += fmt::format(" {} starts from an earlier run.", basin_.resumed_from);
    struct {
      double seconds, cpu_seconds;
      int threads;
      std::string cpu_target;
    } run{basin_.seconds, basin_.cpu_seconds, basin_.threads, basin_.cpu_target};
    for (const TriedChange& t : tried_) run.seconds += t.seconds, run.cpu_seconds += t.cpu_seconds;
    add_origin(document_, study_, text, computed_text(run));
  }

  const MachinePage& page_;
  const std::span<const TriedChange> tried_;
  const BasinResult& basin_;
  const Study& study_;
  const bool physical_;
  const PageQuantities shown_;
  Document document_;
};

}  // namespace

std::string machine_html(const MachinePage& page, std::span<const TriedChange> tried) {
  return document_page(MachineDocument(page, tried).make(), page.basin.study, page);
}

}  // namespace equipoise
