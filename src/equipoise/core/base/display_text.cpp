// UTF-8 as in RFC 3629: shortest forms only, no surrogates, nothing above U+10FFFF.
#include "equipoise/core/base/display_text.hpp"

#include <fmt/format.h>

namespace equipoise {

namespace {

unsigned char byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

// U+2028, U+2029: another line. U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069: what follows may be shown in
// another order.
bool moves_text(unsigned lead, unsigned next, unsigned last) {
  if (lead != 0xE2) return false;
  return (next == 0x80 && (last == 0x8E || last == 0x8F || (last >= 0xA8 && last <= 0xAE))) ||
         (next == 0x81 && last >= 0xA6 && last <= 0xA9);
}

}  // namespace

std::size_t character_length(std::string_view text, std::size_t at) {
  const unsigned char lead = byte_at(text, at), next = byte_at(text, at + 1);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xC2 && lead <= 0xDF   ? 2
                             : (lead & 0xF0) == 0xE0        ? 3
                             : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                            : 0;
  if ((lead == 0xE0 && next < 0xA0) || (lead == 0xED && next > 0x9F)) return 0;
  if ((lead == 0xF0 && next < 0x90) || (lead == 0xF4 && next > 0x8F)) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte_at(text, at + k) & 0xC0) != 0x80) return 0;
  return length;
}

std::string display_text(std::string_view text, std::size_t longest) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    if (shown.size() >= longest) return shown + "...";
    const std::size_t length = character_length(text, at);
    const unsigned char lead = byte_at(text, at), next = byte_at(text, at + 1);
    if (length == 0)
      shown += "\xEF\xBF\xBD";
    else if (length == 1 && (lead < 0x20 || lead == 0x7F))
      shown += fmt::format("\\u{:04X}", lead);
    else if (length == 2 && lead == 0xC2 && next < 0xA0)  // also control characters
      shown += fmt::format("\\u{:04X}", next);
    else if (length == 3 && moves_text(lead, next, byte_at(text, at + 2)))
      shown += fmt::format("\\u{:04X}", (lead & 0x0F) << 12 | (next & 0x3F) << 6 | (byte_at(text, at + 2) & 0x3F));
    else
      shown += text.substr(at, length);
    at += length == 0 ? 1 : length;
  }
  return shown;
}

std::string display_lines(std::string_view text) {
  std::string shown;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of("\n\t", begin), text.size());
    shown += display_text(text.substr(begin, end - begin));
    if (end < text.size()) shown += text[end];
    begin = end + 1;
  }
  return shown;
}

}  // namespace equipoise
