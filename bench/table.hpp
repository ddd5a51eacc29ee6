// Tables and figures for a terminal.
#pragma once

#include <string>
#include <vector>

namespace equipoise::bench {

/// Columns as wide as their widest cell; the first is aligned left, the others right.
class Table {
 public:
  explicit Table(std::vector<std::string> heads) { rows_.push_back(std::move(heads)); }
  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  void print() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// A heading, underlined.
void print_heading(const std::string& text);
/// A paragraph, broken before column 120; its later lines are indented by `hang` more.
void print_paragraph(const std::string& text, std::size_t hang = 0);
/// A line on standard error, for who is waiting.
void say(const std::string& text);

/// Three significant digits at least, thousands parted by a space: 38 964, 17.3, 0.0041.
std::string figure(double value);
/// "least .. most" in the same form.
std::string range(double least, double most);
/// A rounded count, thousands parted by a space.
std::string count(double value);

}  // namespace equipoise::bench
