// Snapshots: text files of messages that tests compare as a whole and `./dev snapshots` renews.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "files.hpp"
#include "studies.hpp"

namespace equipoise {

inline std::string snapshot_path(const std::string& name) { return EQUIPOISE_SOURCE_DIR "/tests/snapshots/" + name; }

/// Expects tests/snapshots/NAME to be `text`.
inline void expect_snapshot(const std::string& name, const std::string& text) {
  if (std::getenv("EQUIPOISE_RENEW")) std::ofstream(snapshot_path(name), std::ios::binary) << text;
  EXPECT_EQ(content(snapshot_path(name)), text) << "if tests/snapshots/" << name << " is to say this: ./dev snapshots";
}

/// Of docs/NAME what stands between "<!-- MARK -->" and the next "<!-- end" is the mark's table.
inline void expect_in_docs(const std::string& name, const std::map<std::string, std::string>& tables) {
  const std::string path = EQUIPOISE_SOURCE_DIR "/docs/" + name;
  std::string renewed = content(path);
  for (const auto& [mark, table] : tables) {
    const std::string begin = "<!-- " + mark + " -->\n";
    const std::size_t at = renewed.find(begin);
    ASSERT_NE(at, std::string::npos) << path << " lacks " << begin;
    const std::size_t from = at + begin.size();
    renewed.replace(from, renewed.find("<!-- end", from) - from, table);
  }
  if (std::getenv("EQUIPOISE_RENEW")) std::ofstream(path, std::ios::binary) << renewed;
  EXPECT_EQ(content(path), renewed) << "./dev snapshots writes the tables anew";
}

/// A study that something is said of.
struct StudyCase {
  std::string text;
  std::vector<std::string> overrides;
};

/// A snapshot of cases, each one or more lines of
///     replace A => B, drop A, begin A, add A, text A, set KEY=VALUE or as it is
/// and below them, indented, the message from `says`. The change applies to the last `of NAME` of `texts`.
inline void expect_said(const std::string& name, const std::map<std::string, std::string>& texts,
                        const std::function<std::string(const StudyCase&)>& says) {
  std::istringstream lines(content(snapshot_path(name)));
  std::string base, written;
  StudyCase now;
  bool open = false;
  const auto close = [&] {
    if (!open) return;
    std::istringstream said(says(now));
    for (std::string line; std::getline(said, line);) written += "    " + line + "\n";
    open = false;
  };
  for (std::string line; std::getline(lines, line);) {
    const bool said = line.starts_with("    "),
               ends = said || line.empty() || line[0] == '#' || line.starts_with("of ");
    if (ends) close();
    if (said) continue;
    written += line + "\n";
    if (line.starts_with("of ")) base = texts.at(line.substr(3));
    if (ends) continue;
    if (!open) now = {base, {}};
    open = true;
    const std::size_t space = std::min(line.find(' '), line.size());
    const std::string verb = line.substr(0, space);
    std::string rest = space < line.size() ? line.substr(space + 1) : "";
    if (verb != "set")
      for (std::size_t at; (at = rest.find("\\n")) != std::string::npos;) rest.replace(at, 2, "\n");
    if (verb == "set") {
      now.overrides.push_back(rest);
    } else if (verb == "replace") {
      now.text = with(now.text, rest.substr(0, rest.find(" => ")), rest.substr(rest.find(" => ") + 4));
    } else if (verb == "drop") {
      now.text = with(now.text, rest, "");
    } else if (verb == "begin" || verb == "add") {
      now.text.insert(verb == "add" ? now.text.size() : 0, rest);
    } else if (verb == "text") {
      now.text = rest;
    } else if (line != "as it is") {
      throw std::logic_error(name + ": " + line);
    }
  }
  close();
  expect_snapshot(name, written);
}

}  // namespace equipoise
