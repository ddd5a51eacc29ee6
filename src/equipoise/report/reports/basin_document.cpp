// An ensemble as one document: the verdict, what matters most of vibration, the outcomes, what was computed; in full
// with transients and the grounds of decisions; on a page with drawings.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/reports/basin_parts.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// The grounds on which starts were decided, as shares of all starts.
std::string decided_text(const BasinResult& r) {
  if (r.starts == 0) return "";
  std::array<std::uint64_t, decided_by_count> counts{};
  for (const OutcomeShare& a : r.attractors)
    for (int k = 0; k < decided_by_count; ++k) counts[k] += a.decided_by[k];
  std::string text;
  for (int k = 1; k < decided_by_count; ++k)
    if (counts[k] > 0)
      text += fmt::format("{}{} {:.2f} %", text.empty() ? "" : ", ", decided_by_names[k],
                          100.0 * static_cast<double>(counts[k]) / static_cast<double>(r.starts));
  return text.empty() ? "" : fmt::format("Decided by: {} of all starts.\n", text);
}

// Shares of starts that passed the resonance, that did not, and for which this is unknown.
std::string passage_text(const BasinResult& r) {
  const Share &passed = *r.passed, &held = *r.not_passed;
  const double above = r.study.passed_speed();
  const bool from_above = std::fabs(r.study.speed.initial) >= above;
  const auto part = [](const Share& s) { return fmt::format("{} ({})", percent(s.share, digits_for(s)), interval(s)); };
  std::string text = fmt::format("{}: {} of all starts ({}), turning faster than {} in their motion or when last seen",
                                 from_above ? "Above the resonance in the end" : "Came through the resonance",
                                 percent(passed.share, digits_for(passed)), interval(passed),
                                 engineering(r.study.scales, above, study::Dimension::speed));
  if (held.count > 0) text += fmt::format("; held below: {}", part(held));
  const std::uint64_t open = passed.total - passed.count - held.count - r.lost();
  if (open > 0)
    text += fmt::format("; not known yet: {}, undecided and slower when last seen",
                        percent_text(static_cast<double>(open) / static_cast<double>(passed.total)));
  if (open > 0 && (passed.least > 0.0 || passed.most < 1.0))
    text += "; through, whatever the others do: " + bounds_text(passed);
  return text + ".\n";
}

// Whether collisions of balls mattered.
std::string contact_text(const Share& met) {
  if (met.count == 0)
    return "Contact: in no run did balls touch before the outcome was known, so contact decided none.\n";
  return fmt::format("Contact: balls touched in {} of all starts ({}) before the outcome was known.\n",
                     percent(met.share, digits_for(met)), interval(met));
}

// "No start was undecided, diverged or failed (each below 0.19 %)." "No start came to: co-drifting, chaotic; locked;
// and none diverged or failed (...)." What undecided starts may still come to has a bound of its own.
std::string none_words(const BasinResult& r) {
  const bool physical = r.study.scales.has_value(), open = r.undecided.count > 0;
  std::vector<std::string> motions, ends;
  const Share *of_motions = nullptr, *of_ends = nullptr;
  for (const OutcomeShare& a : r.attractors) {
    if (a.share.count > 0 || a.id == balanced_id) continue;
    motions.push_back(reader_title(a, physical));
    of_motions = &a.share;
  }
  for (const OutcomeShare& o : r.others()) {
    if (o.share.count > 0) continue;
    of_ends = r.of(o.id);
    ends.push_back(o.id == undecided_code ? "was undecided" : end_name(r, o));
  }
  if (!of_ends) return "";
  const auto each = [](std::size_t count) { return count > 1 ? "each " : ""; };
  // Names of motions may hold commas.
  std::string text = "No start ";
  if (!motions.empty()) text += fmt::format("{}{}", "came to: ", fmt::join(motions, "; "));
  if (!motions.empty() && open)
    text += fmt::format(" ({}at most {}, however the undecided starts end)", each(motions.size()),
                        percent(of_motions->most, digits_for(*of_motions)));
  if (!motions.empty()) text += "; and none ";
  for (std::size_t k = 0; k < ends.size(); ++k) text += (k == 0 ? "" : k + 1 < ends.size() ? ", " : " or ") + ends[k];
  return text + fmt::format("{} ({}{}).", open ? " while followed" : "",
                            each(open ? ends.size() : motions.size() + ends.size()), interval(*of_ends));
}

class BasinDocument {
 public:
  BasinDocument(const BasinResult& r, std::span<const TriedChange> tried, const MachinePage* page)
      : r_(r), tried_(tried), page_(page), study_(r.study), shown_(r.study) {
    if (r.transients) all_ = r.transients->of(std::nullopt);
  }

  Document make(bool brief) {
    const auto verdict = verdict_of(r_, tried_);
    std::optional<Notice> notice;
    if (verdict) notice = verdict_notice(*verdict);
    const std::string answer = notice && !page_ ? "" : answer_sentence(r_);  // a page has room for both
    document_ = document_with(study_, answer, r_.own_starts ? "" : uncertain_text(study_), notice);
    if (brief) document_.blocks.pop_back();  // the study is at the end, in short
    stopped();
    if (study_.parameters.balls > 0 && !r_.note.empty())
      document_.add(Paragraph{fmt::format("Note: {}.", note_text(study_, r_.note)), Tone::open});
    brief ? in_brief() : in_full();
    return std::move(document_);
  }

 private:
  void in_brief() {
    hanging();
    if (study_.parameters.balls == 0 && r_.without_balls) {
      document_.add(bare_table(r_));
      say(without_balls_words(r_));
    } else if (r_.starts > 0) {
      // Vibration is what counts in a machine, and probabilities in a rotor without units.
      std::vector<DocumentTable> tables{outcome_table(r_, true)};
      if (all_) tables.insert(study_.scales ? tables.begin() : tables.end(), short_table(r_));
      for (DocumentTable& table : tables) document_.add(std::move(table));
      if (r_.sensitivity) add_sensitivity(document_, *r_.sensitivity);
      if (tells_without_balls(r_)) say(not_steady_words(r_.without_balls->bare, "Without balls", study_));
    }
    in_short();
  }

  void in_full() {
    if (page_) changes();
    if (page_ && !page_->runs.empty()) {
      const bool constant = study_.speed.profile == Profile::constant;
      document_.add(Heading{2, constant ? "How it vibrates" : "How it vibrates during start-up", ""});
      document_.add(run_up_drawing(*page_));
    }
    const bool balls = study_.parameters.balls > 0;
    if (!balls && r_.without_balls) alone();
    if (balls && r_.starts > 0) {
      ends();
      way();
      kept();
      more();
    }
    origin();
  }

  void say(const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) document_.add(Paragraph{sentence});
  }

  // That the result was stopped early, if so.
  void stopped() {
    if (study_.parameters.balls == 0 ? r_.without_balls.has_value() : !r_.partial && r_.starts > 0) return;
    std::string text = "PARTIAL: stopped before anything was known.";
    if (study_.parameters.balls > 0)
      text = r_.starts == 0 ? "PARTIAL: stopped before the first start was decided; there are no shares."
                            : fmt::format("PARTIAL: stopped after {}{} starts; all figures are of those.", r_.starts,
                                          r_.asked > 0 ? fmt::format(" of {}", r_.asked) : "");
    document_.add(Paragraph{text, Tone::bad});
  }

  // A warning if balls may hang at the final speed.
  void hanging() {
    if (const std::string words = hanging_text(study_); !words.empty())
      document_.add(Paragraph{fmt::format("Warning: {}.", words), Tone::open});
  }

  void changes() {
    DocumentTable table = changes_table(r_, tried_);
    if (table.rows.empty()) return;
    document_.add(Heading{2, "What to change", ""});
    document_.add(std::move(table));
  }

  // A rotor that has no balls.
  void alone() {
    document_.add(Heading{2, "The rotor alone", ""});
    document_.add(Paragraph{bare_words(r_)});
    document_.add(bare_table(r_));
    say(without_balls_words(r_));
    kept();
  }

  // Limits and standards.
  void kept() {
    std::vector<Block> limits = all_ ? limits_blocks(*all_, study_) : std::vector<Block>(),
                       standards = standards_blocks(r_);
    if (limits.empty() && standards.empty()) return;
    document_.add(Heading{2, limits.empty() ? "Standards" : standards.empty() ? "Limits" : "Limits and standards", ""});
    for (std::vector<Block>* of : {&limits, &standards})
      for (Block& block : *of) document_.add(std::move(block));
  }

  // Where starts end, and how large peaks are before that.
  void ends() {
    document_.add(Heading{2, "Where starts end", ""});
    if (page_) document_.add(ends_drawing(*page_));
    document_.add(outcome_table(r_, false));
    if (const std::string none = none_words(r_); !none.empty()) document_.add(Paragraph{none});
    document_.add_lines(left_unbalance_text(r_.attractors, study_));
  }

  // Transients before that.
  void way() {
    if (!all_) return;
    document_.add(Heading{2, "On the way", ""});
    document_.add(way_table(r_));
    if (tells_without_balls(r_)) say(without_balls_words(r_));
  }

  void more() {
    if (r_.transients && !page_) add_transients(document_, *r_.transients, study_);
    if (r_.sensitivity) add_sensitivity(document_, *r_.sensitivity);
    if (!page_) document_.add_lines(decided_text(r_));
    if (r_.passed) document_.add_lines(passage_text(r_));
    if (r_.met) document_.add_lines(contact_text(*r_.met));
    if (!page_) hanging();
    document_.add_lines(sampling_text(r_));
  }

  // How that is known.
  void origin() {
    std::string words;
    if (study_.parameters.balls > 0 && r_.starts > 0)
      words = fmt::format("{} starts{}, each followed until it is known where it ends (undecided after {}).", r_.starts,
                          r_.own_starts ? "" : " " + starts_words(study_, drawn_keys(study_)),
                          shown_.text(study_.numerics.horizon.value_or(0.0), Dimension::time));
    if (r_.resumed_from > 0) words += fmt::format(" {} of them from an earlier run.", r_.resumed_from);
    std::string computed = computed_text(r_);
    if (r_.starts > 0)
      computed += fmt::format(", {:.0f} starts/s", static_cast<double>(r_.starts - r_.resumed_from) / r_.seconds);
    double seconds = 0.0, cpu_seconds = 0.0;
    for (const TriedChange& t : tried_) seconds += t.seconds, cpu_seconds += t.cpu_seconds;
    if (!tried_.empty()) computed += fmt::format("; the changes judged: {:.2f} s, {:.2f} s CPU", seconds, cpu_seconds);
    if (words.empty()) return document_.add(Paragraph{fmt::format("Equipoise {}; {}.", version_string, computed)});
    add_origin(document_, study_, words, computed);
  }

  // What the numbers are of.
  void in_short() {
    const model::Parameters& p = study_.parameters;
    const auto shown = [&](double value, Dimension d) { return shown_.text(value, d); };
    std::string words = study_.scales
                            ? fmt::format("Machine: {}", shown(1.0, Dimension::mass))
                            : fmt::format("Rotor: eccentricity {:.4g}, damping {:.4g}", p.eccentricity, p.damping[0]);
    if (!p.tilts() && study_.scales) {
      const auto critical = model::critical_speeds(p);
      words += fmt::format(", critical speed {}", shown(critical[0], Dimension::speed));
      if (critical[0] != critical[1]) words += fmt::format(" and {} (x, y)", shown(critical[1], Dimension::speed));
    }
    if (!study_.speed.driven())
      words += fmt::format(", run at {}", shown(study_.speed_profile().final_speed(), Dimension::speed));
    words += fmt::format("; {} ball{}", p.balls, plural(p.balls));
    if (p.balls > 0 && study_.scales) words += fmt::format(" on a circle of {}", shown(1.0, Dimension::length));
    if (study_.speed.law == model::SpeedLaw::published && study_.speed.profile != Profile::constant)
      words += "; PUBLISHED speed law, psi = t Omega(t)";
    words += ".";
    if (const std::string held = release_text(study_); p.balls > 0 && !held.empty())
      words += fmt::format(" {}.", capitalised(held));
    if (all_)
      words +=
          tells_without_balls(r_) ? " \"No balls\" and \"with balls\" are medians." : " \"With balls\" is the median.";
    if (all_ && !study_.scales) words += " Units: R, R omega_c, M R omega_c^2, 1/omega_c.";
    if (all_ && study_.parameters.gravity != 0.0)
      words += " Displacements are from where the rotor rests; forces include its weight.";
    if (all_ && study_.parameters.tilts()) words += " Where along the shaft figures are taken: --details.";
    if (r_.starts > 0) {
      const std::vector<std::string> drawn = drawn_keys(study_);
      const bool plain = study_.sampling.method.value_or(SamplingMethod::random) == SamplingMethod::random &&
                         drawn.empty() && study_.sampling.box.empty() && drawn_instead(study_).empty();
      words += fmt::format(" {} runs{},", r_.starts,
                           r_.own_starts ? " from given starts"
                           : plain       ? fmt::format(", seed {}", study_.sampling.seed)
                                         : " " + starts_words(study_, drawn));
    }
    document_.add(Paragraph{fmt::format("{} {:.2g} s CPU time. More: --details, --json.", words, r_.cpu_seconds)});
  }

  const BasinResult& r_;
  const std::span<const TriedChange> tried_;
  const MachinePage* page_;  // null: no drawings
  const TransientGroup* all_ = nullptr;
  const Study& study_;
  const PageQuantities shown_;
  Document document_;
};

}  // namespace

std::string basin_text(const BasinResult& result, const TextStyle& style, std::span<const TriedChange> tried) {
  return document_text(BasinDocument(result, tried, nullptr).make(!style.details), style);
}

std::string machine_html(const MachinePage& page, std::span<const TriedChange> tried) {
  return document_page(BasinDocument(page.basin, tried, &page).make(false), page.basin.study, page);
}

}  // namespace equipoise
