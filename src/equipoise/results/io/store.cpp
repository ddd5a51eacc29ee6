// Opens both files of a store, and replaces them by finished results.
#include "equipoise/results/io/store.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise::io {

namespace {

// Seconds. Less work is soon repeated, and a sweep has a thousand such pieces.
constexpr double worth_keeping = 2.0;

bool is_note(const Journal::Record& record) { return record.kind == Journal::Kind::note; }

}  // namespace

// A note is a record with page and number as `first` and `count`.
Store::Store(const std::string& path, const std::string& identity, const Words& words)
    : words_(words),
      path_(results_path(path)),
      part_(path_ + ".part"),
      identity_(identity),
      notes_(
          [this](std::uint64_t page, std::uint64_t number, const std::vector<char>& answer) {
            try {
              if (!full_) journal_->append({Journal::Kind::note, page, number}, answer.data(), answer.size());
            } catch (const RunError&) {  // if results cannot be written either, they report it
              full_ = true;
            }
          },
          worth_keeping) {
  journal_.emplace(part_, path_, identity);
  if (std::filesystem::exists(path_)) require_same(open_results(), identity, path_, words.results, words.allowed);
  require_same(journal_->identity(), identity, part_, words.results, words.allowed);
  for (const Journal::Record& record : journal_->records())
    if (is_note(record)) notes_.know(record.first, record.count, payload<std::vector<char>>(record));
}

Store::Store(const std::string& path, const Words& words) : words_(words), path_(path), part_(path) {
  if (std::error_code ignored; !std::filesystem::exists(path, ignored)) throw InputError(path, "", "", "no such file");
  if (!is_netcdf(path)) journal_.emplace(path);
  identity_ = journal_ ? journal_->identity() : open_results();
}

std::string Store::open_results() {
  if (const std::string damage = why_not_whole(path_); !damage.empty()) refuse(path_, damage);
  std::string identity;
  reading([&] { identity = results_.emplace(path_, NetcdfFile::Mode::read).lines("identity"); });
  return identity;
}

void Store::refuse(const std::string& file, const std::string& problem) const {
  throw InputError(file, "", "", fmt::format("{}; {}", problem, words_.allowed));
}

void Store::reading(const std::function<void()>& read) const {
  try {
    read();
  } catch (const RunError& e) {
    refuse(path_, fmt::format("is damaged ({})", e.what()));
  }
}

std::vector<Journal::Record> Store::records() const {
  std::vector<Journal::Record> records;
  if (journal_)
    std::remove_copy_if(journal_->records().begin(), journal_->records().end(), std::back_inserter(records), is_note);
  return records;
}

std::string Store::loss() const {
  const std::string damage = journal_ ? journal_->loss() : "";
  return damage.empty() ? "" : fmt::format("{}: {}", part_, damage);
}

Journal::Record Store::append(const Journal::Record& record, const void* payload, std::size_t bytes) {
  try {
    return journal_->append(record, payload, bytes);
  } catch (const RunError& e) {
    throw RunError(fmt::format("{}; {}", e.what(), journal_->kept()));
  }
}

void Store::finish(const std::function<void(const std::string&)>& write, Rest rest) {
  try {
    journal_->require_sound();
    write(path_);
  } catch (const RunError& e) {
    throw RunError(fmt::format("{}; {}", e.what(), journal_->kept()));
  }
  if (rest == Rest::nothing) journal_->remove();
  if (rest == Rest::notes) journal_->keep_only(Journal::Kind::note);
}

}  // namespace equipoise::io
