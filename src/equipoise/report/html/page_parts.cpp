// Tables about the machine, from the study's tree and what explain() finds, and words about the run.
#include "equipoise/report/html/page_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/study/sampling/sampling.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// "angle-grinder" from "studies/angle-grinder.toml"; the same for files of results.
std::string stem_of(const std::string& name) {
  const std::size_t folder = name.find_last_of('/');
  std::string stem = folder == std::string::npos ? name : name.substr(folder + 1);
  for (const std::string_view ending : {".toml", ".nc"})
    if (stem.ends_with(ending)) stem.erase(stem.size() - ending.size());
  return stem.empty() ? "study" : stem;
}

// A rule of thumb's figures in one line.
std::string figures_words(const RuleOfThumb& rule, const Study& study) {
  const PageQuantities shown(study);
  std::string text;
  for (std::size_t k = 0; k < rule.figures.size(); ++k) {
    const ExplainedQuantity& f = rule.figures[k];
    if (k + 1 < rule.figures.size() && rule.figures[k + 1].name == f.name)
      continue;  // drag: the machine's own figure
                 // follows
    const std::string value = !f.dimension                       ? page_number(f.value)
                              : *f.dimension == Dimension::angle ? page_number(f.value * 180.0 / pi) + "°"
                                                                 : shown.text(f.value, *f.dimension);
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", f.name, value);
  }
  return text;
}

DocumentTable advice_table(const Explanation& e) {
  DocumentTable table{{"rule of thumb", "an estimate by a formula", "figures"},
                      {},
                      "Estimates by formulas; the documentation, \"Rules of thumb\", shows how often each is right.",
                      true,
                      {2}};
  for (const RuleOfThumb& rule : e.advice)
    table.rows.push_back({label_cell(rule.name),
                          {rule.words, !rule.kept   ? Tone::plain
                                       : *rule.kept ? Tone::good
                                                    : Tone::open},
                          {figures_words(rule, e.study)}});
  return table;
}

// What follows from a study without simulation, but for what only specialists ask.
DocumentTable facts_table(const Explanation& e) {
  constexpr std::array<std::string_view, 6> shown{"critical speed",      "final speed",   "can balance",
                                                  "approach to balance", "without balls", "balance quality"};
  const PageQuantities quantities(e.study);
  const auto one = [&](double value, Dimension d) { return quantities.text(value, d); };
  const FactNumbers numbers{one, one,
                            [&](double low, double high, Dimension d) { return quantities.range(low, high, d); }};
  DocumentTable table{{"follows", "without any simulation"}};
  for (const Fact& fact : facts(e, numbers))
    if (std::find(shown.begin(), shown.end(), fact.name) != shown.end())
      table.rows.push_back({label_cell(fact.name), {fmt::format("{}", fmt::join(fact.lines, "; "))}});
  return table;
}

std::string distribution_text(const UncertainValue& v) {
  switch (v.kind) {
    case DistributionKind::uniform:
      return fmt::format("uniform, {} to {}", v.text(v.numbers[0]), v.text(v.numbers[1]));
    case DistributionKind::loguniform:
      return fmt::format("log-uniform, {} to {}", v.text(v.numbers[0]), v.text(v.numbers[1]));
    case DistributionKind::normal: {
      const std::string cut =
          v.between ? fmt::format(", cut to {} to {}", v.text((*v.between)[0]), v.text((*v.between)[1])) : "";
      return fmt::format("normal, mean {}, standard deviation {}{}", v.text(v.numbers[0]), v.text(v.numbers[1]), cut);
    }
    case DistributionKind::values:
      break;
  }
  constexpr std::size_t most_shown = 6;
  std::string text = "one of ";
  for (std::size_t k = 0; k < std::min(v.numbers.size(), most_shown); ++k)
    text += (k ? ", " : "") + v.text(v.numbers[k]);
  return v.numbers.size() > most_shown ? fmt::format("{}, .. ({} values)", text, v.numbers.size()) : text;
}

}  // namespace

Document document_with(const Study& study, const std::string& answer, const std::string& drawn,
                       const std::optional<Notice>& verdict) {
  Document document{"Ball balancer: " + stem_of(study.name), {}, true};
  if (verdict) document.add(*verdict);
  if (!answer.empty()) document.add(Paragraph{answer, Tone::plain, true});
  std::string lines = study_heading(study) + drawn, held = release_text(study);
  lines.erase(lines.find_last_not_of('\n') + 1);
  if (!held.empty()) held = capitalised(held) + ".";
  document.add(Brief{lines, held});
  return document;
}

std::string uncertain_text(const Study& study, const std::vector<std::string>& set) {
  std::string text;
  for (const UncertainValue& v : study.uncertain.values)
    if (std::find(set.begin(), set.end(), v.key) == set.end())
      text += fmt::format("drawn with each start: {} {}\n", v.key, distribution_text(v));
  text += drawn_instead_text(study);
  return text.empty() ? text : text + "\n";
}

std::string starts_words(const Study& study, const std::vector<std::string>& drawn) {
  const auto method = static_cast<std::size_t>(study.sampling.method.value_or(SamplingMethod::random));
  const std::vector<std::string> instead = drawn_instead(study);
  return fmt::format("at {} ball angles{}{}, seed {}{}", sampling_method_names[method],
                     study.sampling.box.empty() ? "" : " and in the box of initial states",
                     drawn.empty() ? "" : fmt::format(", with {} drawn for each", fmt::join(drawn, ", ")),
                     study.sampling.seed,
                     instead.empty() ? "" : fmt::format(" (not from {} of the study)", fmt::join(instead, ", ")));
}

std::string varied_words(const std::vector<SweepAxis>& axes) {
  constexpr std::size_t few = 6;
  std::string text;
  visit_parameters(axes, 0, [&](const SweepParameter& p, std::size_t) {
    const std::size_t count = p.given.size();
    text += text.empty() ? "" : "; ";
    text += count <= few
                ? fmt::format("{} {}", key_words(p.key), fmt::join(p.given, ", "))
                : fmt::format("{} from {} to {} ({} values)", key_words(p.key), p.given.front(), p.given.back(), count);
  });
  return text;
}

void add_origin(Document& document, const Study& study, const std::string& words, const std::string& computed) {
  std::string text = words;
  if (!study.speed.driven() && study.speed.profile != Profile::constant)
    text += fmt::format(" Speed law: {}.", name_of(study.speed.law));
  text += fmt::format(" Intervals hold with 95 % confidence. The model: {}; equipoise {}{}{}.",
                      study.parameters.tilts() ? "a rigid tilting rotor" : "a rotor in a plane", version_string,
                      computed.empty() ? "" : "; ", computed);
  document.add(Heading{2, "How it was computed", ""});
  document.add(Paragraph{text});
}

namespace {

std::string words_of(const std::string& key) {
  std::string words = key;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

// `between`: the keys of a table.
std::string words_of_value(const StudyValue& value, const char* between = ", ") {
  if (const auto* table = value.table()) {
    std::string text;
    for (const auto& [key, member] : *table)
      text += fmt::format("{}{} {}", text.empty() ? "" : between, words_of(key), words_of_value(member));
    return text;
  }
  if (const auto* array = value.array()) {
    constexpr std::size_t most = 12;
    std::string text;
    for (std::size_t k = 0; k < array->size() && k < most; ++k) text += (k ? ", " : "") + words_of_value((*array)[k]);
    return array->size() > most ? text + ", ..." : text;
  }
  if (const auto* truth = value.boolean()) return *truth ? "yes" : "no";
  if (const auto* whole = value.integer()) return fmt::format("{}", *whole);
  if (const auto* number = value.real()) return fmt::format("{}", *number);
  return value.string() ? *value.string() : value.other()->text;
}

std::vector<GivenTable> tables_of(const StudyValue& root) {
  std::vector<GivenTable> tables;
  const auto add = [&](const std::string& name, const StudyValue& value) {
    if (value.table() && !value.table()->empty()) tables.push_back({name, words_of_value(value, "; ")});
  };
  for (const char* name : told_tables) {
    const StudyValue* found = root.find(name);
    if (!found) continue;
    add(name, *found);
    for (std::size_t k = 0; found->array() && k < found->array()->size(); ++k)
      add(fmt::format("{} {}", name, k + 1), (*found->array())[k]);
  }
  return tables;
}

}  // namespace

std::vector<GivenTable> given_tables(const std::string& toml_text, const std::string& name,
                                     const std::vector<std::string>& overrides) {
  return tables_of(study::parse_study_file(toml_text, name, overrides).root);
}

std::vector<GivenTable> given_tables(const Study& study) {
  return study.scales ? given_tables(to_physical_toml(study), study.name) : tables_of(to_tree(study));
}

GivenMachine given_machine(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides, const StopFlag* stop) {
  const Study study = parse_study(toml_text, name, overrides);
  check_pages(study);
  StudyCheck checked = check_study(toml_text, name, overrides, stop);
  // A page's starts draw them.
  std::erase_if(checked.assumed, [](const std::string& text) { return text.starts_with(medians_assumed); });
  return {given_tables(toml_text, name, overrides), explain(study, stop), std::move(checked.assumed),
          std::move(checked.most)};
}

GivenMachine given_machine(const Study& study) {
  check_pages(study);
  return {given_tables(study), explain(study), {}, {}};
}

namespace {

// The study's statements, what follows, rules of thumb and warnings.
void add_machine(Document& document, const GivenMachine& machine) {
  if (!machine.assumed.empty()) {
    document.add(Heading{2, "What was assumed", ""});
    document.add(ItemList{machine.assumed});
    if (!machine.matters_most.empty()) document.add(Paragraph{"Most sensitive to: " + machine.matters_most + "."});
  }
  document.add(Heading{2, "The machine", ""});
  DocumentTable table{{"given", "in the study"}};
  for (const auto& [name, keys] : machine.given) table.rows.push_back({label_cell(name), {keys}});
  document.add(std::move(table));
  document.add(facts_table(machine.explanation));
  if (DocumentTable rules = advice_table(machine.explanation); !rules.rows.empty()) document.add(std::move(rules));
  for (const std::string& warning : machine.explanation.warnings)
    document.add(Paragraph{"Beware: " + warning + ".", Tone::open});
}

}  // namespace

std::string document_page(Document document, const Study& study, const GivenMachine& machine) {
  add_machine(document, machine);
  if (study.scales) document.add(Listing{"The study in full, in physical units", to_physical_toml(study)});
  document.add(
      Listing{study.scales ? "The same without dimensions, as it was computed" : "The study in full", to_toml(study)});
  return document_html(document);
}

}  // namespace equipoise
