// Results that grow from run to run: what is finished, and a journal of what is new.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/running/search_log.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/io/journal.hpp"

namespace equipoise::io {

/// Results of one identity, kept in two files. The finished results, `path`, are NetCDF, sealed (replacement.hpp) and
/// always written whole. During a run, the journal `path`.part holds what is new: a run that is killed loses a second's
/// work. It also holds the search log. Only one run at a time may use a store.
class Store {
 public:
  /// In what refuses other files: "results of this study"; what a file must be.
  struct Words {
    std::string results, allowed;
  };
  /// Opens what both files hold of these results, or begins again. Throws InputError if they cannot be written, are in
  /// use, are damaged, or hold something else, and says which.
  Store(const std::string& path, const std::string& identity, const Words& words);
  /// Only reads `path`: finished results or a journal (.part), whatever their identity.
  Store(const std::string& path, const Words& words);

  const std::string& path() const { return path_; }
  const std::string& identity() const { return identity_; }
  /// The finished results; null if there are none yet.
  const NetcdfFile* results() const { return results_ ? &*results_ : nullptr; }
  /// Whether they say that nothing is missing.
  bool says_complete() const { return results_ && results_->attribute("complete") == "yes"; }
  /// What is damaged in the journal, in words; empty if nothing.
  std::string loss() const;
  /// The search log of earlier runs that did not finish.
  SearchLog& notes() { return notes_; }

  /// What stays of the journal next to finished results.
  enum class Rest {
    nothing,  ///< they are complete
    notes,    ///< they hold every record
    all       ///< the journal holds more than they do
  };
  /// Lets `write` write the finished results. Throws RunError, with everything kept as it was, if they cannot be
  /// written or another program has changed the journal.
  void finish(const std::function<void(const std::string& path)>& write, Rest rest);
  /// Removes the journal: all that is needed of it is in the finished results.
  void forget() { journal_->remove(); }

 protected:
  const std::string& part() const { return part_; }
  /// The journal's records except the search log, in order.
  std::vector<Journal::Record> records() const;
  /// Part of a record's payload, or all of it.
  void read_payload(const Journal::Record& record, std::uint64_t offset, std::size_t bytes, void* to) const {
    journal_->read(record, offset, bytes, to);
  }
  template <class Values>
  Values payload(const Journal::Record& record) const {
    Values values;
    values.resize(record.bytes / sizeof(typename Values::value_type));
    read_payload(record, 0, values.size() * sizeof(typename Values::value_type), values.data());
    return values;
  }
  /// On disk within about a second of work. If the disk cannot take it, throws RunError and keeps all earlier records.
  Journal::Record append(const Journal::Record& record, const void* payload, std::size_t bytes);
  [[noreturn]] void refuse(const std::string& file, const std::string& problem) const;
  /// Refuses the finished results if reading them throws RunError.
  void reading(const std::function<void()>& read) const;

 private:
  std::string open_results();  // their identity

  const Words words_;
  const std::string path_, part_;
  std::string identity_;
  std::optional<Journal> journal_;
  std::optional<NetcdfFile> results_;
  bool full_ = false;  // no more notes are kept
  SearchLog notes_;
};

}  // namespace equipoise::io
