// Draws progress: as a bar at most ten times a second, as lines rarely.
#include "progress.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "options.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

std::string duration_text(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 3600.0)
    return fmt::format("{:.0f} min {:02.0f} s", std::floor(seconds / 60.0), std::fmod(seconds, 60.0));
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(seconds / 3600.0), std::fmod(seconds / 60.0, 60.0));
}

std::chrono::duration<double> lines_apart() {
  constexpr char variable[] = "EQUIPOISE_PROGRESS";
  constexpr double usual = 10.0;
  const char* text = std::getenv(variable);
  return std::chrono::duration<double>(
      text && *text ? option_number(variable, text, 0.1, 86400.0, "a number of seconds from 0.1 to 86400") : usual);
}

ProgressLine::ProgressLine(bool quiet, RunOptions& options)
    : style_(quiet                 ? Style::none
             : error_is_terminal() ? Style::bar
                                   : Style::lines),
      begin_(Clock::now()),
      last_(begin_) {
  constexpr std::chrono::milliseconds redrawn{100};
  apart_ = style_ == Style::lines ? lines_apart() : redrawn;
  options.notice = [this](const std::string& sentence) {
    finish();
    say(sentence);
  };
  if (style_ == Style::none && !time_is_limited()) return;
  options.progress = [this](const Progress& progress) { update(progress); };
}

ProgressLine::~ProgressLine() { finish(); }

void ProgressLine::update(const Progress& progress) {
  const auto now = Clock::now();
  const auto& [done, total, what, balanced, preparing] = progress;
  // The rate counts neither work of an earlier run nor another part of the work.
  if (!before_ || done < before_->done || preparing != before_->preparing || (preparing && what != before_->what)) {
    first_ = done;
    begin_ = now;
  }
  before_ = progress;
  told_ = now;
  if (style_ == Style::none) return;
  if (now - last_ < apart_) return;
  last_ = now;
  const double rate = this->rate();
  std::string text;
  if (total > 0) {
    const double fraction = static_cast<double>(done) / static_cast<double>(total);
    if (style_ == Style::bar) {
      constexpr int cells = 24;
      const int full = static_cast<int>(fraction * cells);
      text += "[" + std::string(full, '#') + std::string(cells - full, '.') + "] ";
    }
    text += fmt::format("{:3.0f} %  {} of {}", 100.0 * fraction, done, total);
    if (rate > 0.0)
      text += fmt::format("  {:.0f}/s  {} left", rate, duration_text(static_cast<double>(total - done) / rate));
  } else if (preparing) {
    text += done > 0 ? fmt::format("{}  {}  {:.0f}/s", what, done, rate) : what;
  } else {
    text += fmt::format("{} {}  {:.0f}/s", done, what, rate);
  }
  if (balanced)
    text += fmt::format("  balanced {:.2f} %", 100.0 * *balanced);
  else if (total > 0)
    text += "  " + what;
  if (style_ == Style::bar) {
    text = text.substr(0, terminal_width() - 1);
    put_error("\r" + text + "\x1b[K");
  } else {
    put_error(text + "\n");
  }
  shown_ = true;
}

// Work per second since the current part began.
double ProgressLine::rate() const {
  const double elapsed = std::chrono::duration<double>(told_ - begin_).count();
  return elapsed > 0.0 ? static_cast<double>(before_->done - first_) / elapsed : 0.0;
}

std::optional<WorkLeft> ProgressLine::left() const {
  if (!before_) return std::nullopt;
  const auto& [done, total, what, balanced, preparing] = *before_;
  if (preparing || total == 0) return WorkLeft{0, 0, what};
  WorkLeft left{done, total, what};
  // Where all that is counted is done, what is left is not counted.
  const double per_second = rate();
  if (done < total && per_second > 0.0) left.seconds = static_cast<double>(total - done) / per_second;
  return left;
}

void ProgressLine::finish() {
  if (shown_ && style_ == Style::bar) put_error("\r\x1b[K");
  shown_ = false;
}

}  // namespace equipoise::app
