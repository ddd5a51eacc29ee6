// Attractors as a document and as JSON.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {
using study::Dimension;

constexpr char drift_of_the_balls[] = "drift of the balls";

// The smallest share that is missed with a probability of at most `miss`.
double detection_limit(std::uint64_t starts, double miss) {
  return starts == 0 ? 1.0 : -std::expm1(std::log(miss) / static_cast<double>(starts));
}

constexpr double least_miss = 1e-9;

std::uint64_t decided_starts(const AttractorsResult& r) {
  std::uint64_t count = 0;
  for (const OutcomeShare& a : r.basin.attractors) count += a.share.count;
  return count;
}

const OutcomeShare& share_of(const AttractorsResult& r, int id) {
  return *std::find_if(r.basin.attractors.begin(), r.basin.attractors.end(),
                       [&](const OutcomeShare& s) { return s.id == id; });
}

// The share below which an attractor may be missed: only decided starts count.
std::string search_text(const AttractorsResult& r) {
  const std::uint64_t decided = decided_starts(r), starts = r.basin.starts, undecided = r.basin.undecided.count;
  std::string text = fmt::format("{} starts searched, {} decided", starts, decided);
  if (decided > 0)
    text += fmt::format(": an attractor with a share above {:.2g} of such starts is missed with probability below 1e-9",
                        detection_limit(decided, least_miss));
  text += ".\n";
  if (undecided > 0)
    text += fmt::format("{} of all starts stayed undecided: attractors missing here may hold up to that share.\n",
                        percent(r.basin.undecided.share, digits_for(r.basin.undecided)));
  return text;
}

// A number in the unit in which results are shown.
double shown(const Study& study, double value, Dimension d) { return value * unit_of(study, d).size; }

// What a motor does on a motion: mean speed and how far it wavers to either side, torque, power.
std::vector<std::string> motor_texts(const Motion& m, const Study& study) {
  if (!m.motor) return std::vector<std::string>(4, "-");
  const MotorLoad& load = *m.motor;
  const double waver = 0.5 * (load.speed_max - load.speed_min);
  return {fmt::format("{:.5f}", shown(study, m.speed, Dimension::speed) + 0.0),
          fmt::format("{:.5f}", shown(study, waver, Dimension::speed)),
          fmt::format("{:.5g}", shown(study, load.torque, Dimension::torque)),
          fmt::format("{:.5g}", shown(study, load.power, Dimension::power))};
}

// In rpm four digits are enough, to 1e-4.
std::string drift_text(double drift, bool physical) {
  return physical ? fmt::format("{:.4g}", std::round(1e4 * drift) * 1e-4 + 0.0) : fmt::format("{:.4f}", drift + 0.0);
}

// "locked: 1|2 touch." or "drifting apart: 1|2 strike, 1|2 strike in one period."
std::string events_text(const Attractor& a, int balls) {
  const Motion& m = a.motion;
  if (!m.eventful) return "";
  constexpr std::size_t most = 12;
  std::vector<BallEvent> first = m.events;
  const bool periodic = m.kind == MotionKind::periodic;
  if (first.size() > most) first.resize(most);
  std::string text = text_of(m.mode, balls);
  if (!first.empty())
    text += fmt::format("{}{}{} {}", text.empty() ? "" : "; then ", text_of(first),
                        first.size() < m.events.size() ? ", ..." : "",
                        periodic ? "in one period" : "and so on, without repeating");
  return text.empty() ? "" : fmt::format("{}: {}.\n", a.name, text);
}

// Meaning of the columns for a rotor whose equations depend on its angle.
std::string section_text(const Study& study) {
  const model::System system = study.system();
  if (system.autonomous()) return "";
  const model::Parameters& p = study.parameters;
  std::string text =
      fmt::format("One strobe is {} of the rotor", p.gravity != 0.0 ? "a revolution" : "half a revolution");
  if (system.prescribed())
    text += fmt::format(", {:.5f}{}", shown(study, system.section_period(), Dimension::time), study.scales ? " s" : "");
  if (p.gravity != 0.0)
    text += fmt::format("; r is measured from where the rotor would rest, Y = {:.5g}{}",
                        shown(study, model::static_sag(p), Dimension::length), study.scales ? " mm" : "");
  return text + "; multipliers are over the period, without one of 1.\n";
}

}  // namespace

Document document_of(const AttractorsResult& r) {
  const Study& study = r.basin.study;
  const bool physical = study.scales.has_value(), driven = study.speed.driven();
  Document document = document_with(study, "", "");
  const auto titled = [&](const char* title, Dimension d) {
    return physical ? fmt::format("{}, {}", title, unit_of(study, d).name) : std::string(title);
  };
  DocumentTable table;
  table.header = {"id",
                  "attractor",
                  "kind",
                  "share",
                  "copies",
                  titled("period", Dimension::time),
                  titled("r min", Dimension::length),
                  "mean",
                  titled("r max", Dimension::length),
                  titled(drift_of_the_balls, Dimension::speed),
                  "stability"};
  const auto put_motor = [&](std::vector<std::string>& row, const std::vector<std::string>& texts) {
    if (driven) row.insert(row.end() - 2, texts.begin(), texts.end());
  };
  put_motor(table.header, {titled("speed", Dimension::speed), "+-", titled("torque", Dimension::torque),
                           titled("power", Dimension::power)});
  for (const Attractor& a : r.attractors) {
    const Motion& m = a.motion;
    const Share& share = share_of(r, a.id).share;
    std::string drift;
    for (int i = 0; i < study.parameters.balls; ++i)
      drift += (i ? ", " : "") + drift_text(shown(study, m.drift[i], Dimension::speed), physical);
    const bool measured = m.kind == MotionKind::measured;  // its state is unknown
    const auto r_text = [&](double value) {
      return measured ? "-" : fmt::format("{:.4f}", shown(study, value, Dimension::length));
    };
    std::vector<std::string> row{
        fmt::format("{}", a.id),
        reader_title(a, physical),
        name_of(m.kind),
        share.total ? share_text(share) : "-",
        a.continuum || measured ? "-" : fmt::format("{}", m.copies),
        m.kind == MotionKind::periodic ? fmt::format("{:.5f}", shown(study, m.period, Dimension::time)) : "-",
        r_text(m.r_min),
        r_text(m.r_mean),
        r_text(m.r_max),
        measured ? "-" : drift,
        stability_text(a, study.scales)};
    put_motor(row, motor_texts(m, study));
    table.rows.push_back(row_of(driven ? "nttnnnnnnnnnntt" : "nttnnnnnntt", row));
  }
  // Without these in this order where the terminal is narrow.
  for (const char* title :
       {drift_of_the_balls, "kind", "stability", "speed", "period", "mean", "r min", "power", "torque", "+-", "copies"})
    for (std::size_t k = 0; k < table.header.size(); ++k)
      if (table.header[k].starts_with(title)) table.spare.push_back(k);
  document.add(std::move(table));
  document.add_lines(section_text(study));
  for (const Attractor& a : r.attractors) document.add_lines(events_text(a, study.parameters.balls));
  document.add_lines(left_unbalance_text(r.basin.attractors, study));
  if (!r.basin.note.empty())
    document.add(Paragraph{fmt::format("Note: {}.", note_text(study, r.basin.note)), Tone::open});
  if (r.basin.partial)
    document.add(Paragraph{fmt::format("PARTIAL: stopped after {} of {} starts; the search had not ended: there may be "
                                       "others.",
                                       r.basin.starts, r.basin.asked),
                           Tone::bad});
  document.add_lines(search_text(r));
  document.add(
      Paragraph{fmt::format("seed {}; {}; equipoise {}", study.sampling.seed, computed_text(r.basin), version_string)});
  return document;
}

std::string json_text(const AttractorsResult& r) {
  const BasinResult& b = r.basin;
  const std::uint64_t decided = decided_starts(r);
  Json json;
  json["attractors"] = list_of(r.attractors, [&](const Attractor& a) {
    const OutcomeShare& of = share_of(r, a.id);
    Json one = PartOf{a, b.study};
    put_left_unbalance(one, of, b.study);
    put(one, "share", of.share.share, "share_interval", std::array{of.share.low, of.share.high}, "starts",
        of.share.count, "state", leading(a.motion.state, a.motion.state.size()));
    return one;
  });
  put(json, "starts", b.starts, "partial", b.partial, "decided", decided);
  for (const OutcomeShare& o : b.others())
    if (o.id != stalled_code) json[o.name] = o.share.share;
  put(json, "detection",
      object("share", decided > 0 ? Json(detection_limit(decided, least_miss)) : Json(), "of", "decided starts",
             "miss_probability", least_miss, "missing_at_most", b.undecided.most),
      "note", b.note, "seconds", b.seconds, "threads", b.threads, "cpu_target", b.cpu_target, "study_name",
      b.study.name, "study", b.study, "version", version_string);
  return json.dump(2) + "\n";
}

}  // namespace equipoise
