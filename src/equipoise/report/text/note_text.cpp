// Quantities put into the text of a note.
#include "equipoise/report/text/note_text.hpp"

#include <fmt/format.h>

#include "equipoise/report/text/text.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

std::string quantity_text(const Study& study, const Note& note, const NotedQuantity& q) {
  if (q.kind == NotedQuantity::Kind::speed)
    return study.scales ? "at " + rotor_speed_text(study, q.least) : fmt::format("at speed {:.4g}", q.least);
  if (!study.scales) return note.substr(q.begin, q.length);
  const double scale = study::scale_of(study::Dimension::speed, *study.scales);
  return q.least == q.most ? fmt::format("(growth rate {:.3g} 1/s)", q.least * scale)
                           : fmt::format("(growth rates {:.3g} to {:.3g} 1/s)", q.least * scale, q.most * scale);
}

}  // namespace

std::string note_text(const Study& study, const Note& note) {
  std::string text;
  std::size_t done = 0;
  for (const NotedQuantity& q : note.quantities) {
    text += note.substr(done, q.begin - done) + quantity_text(study, note, q);
    done = q.begin + q.length;
  }
  return text + note.substr(done);
}

}  // namespace equipoise
