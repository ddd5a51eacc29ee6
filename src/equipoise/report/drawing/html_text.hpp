// Escapes text for pages and pictures.
#pragma once

#include <string>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/embedded.hpp"

namespace equipoise::embedded {

/// Files that pages need: "document.css" and "sheet.css".
extern const Archive page_files;

}  // namespace equipoise::embedded

namespace equipoise {

/// `text` as the content of an element or of an attribute in double quotes, in HTML and in XML: with markup characters
/// escaped, and those that XML does not allow shown as escapes. The one way in which text enters markup.
inline std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : display_lines(text)) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

}  // namespace equipoise
