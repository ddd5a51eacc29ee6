// A slice's results, kept as they come; an interrupted run can be resumed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/analyses/basin_slices/pixel_store.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/io/journal.hpp"
#include "equipoise/results/result_files/slice_netcdf.hpp"

namespace equipoise {

/// Two files, as for BasinFile: the results, `path`, in NetCDF (slice_netcdf.hpp), written whole; and during a run
/// `path`.part with what is new.
class SliceStore : public PixelStore {
 public:
  /// Opens what both hold of the same study, axes, version and arithmetic, or begins anew. Throws InputError if they
  /// cannot be written, are in use, are damaged, or hold something else, and says which.
  SliceStore(const std::string& path, const io::SliceFileHeader& header);

  /// Whether `path` holds the whole slice.
  bool complete() const { return file_ && file_->complete(); }
  /// What damage has taken from `path`.part, in words; empty if nothing.
  std::string loss() const { return journal_.loss(); }
  /// Whether something is not in `path` yet.
  bool unfinished() const { return !pieces_.empty(); }
  /// Computed pixels, in any order; some may appear twice.
  void for_each_known(const std::function<void(std::uint32_t position, short code)>& visit) const;
  /// The codes of motions; some may appear twice.
  const std::vector<OutcomeShare>& codes() const { return codes_; }
  /// States on motions first met during earlier runs, in the order of starts: enough to name the motions again.
  const std::vector<std::vector<double>>& discoveries() const { return discoveries_; }

  /// On disk within about a second of work. If the disk cannot take them, throws RunError and keeps all earlier pixels.
  void append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) override;
  /// Adds a code before pixels use it.
  void append_code(const OutcomeShare& code);
  void append_attractor_search(const std::vector<double>& state);
  /// The search log of earlier runs that did not finish. Not for a complete slice.
  SearchLog& notes() { return *notes_; }
  void read_rows(int first, int rows, SlicePixel* pixels) const override;

  /// `write` receives a path and writes the results there. Then the unfinished part is removed, except for the search
  /// log of a slice that is not `complete`. On a full disk, throws RunError and keeps everything as it was.
  void finish(const std::function<void(const std::string& path)>& write, bool complete);

 private:
  // Pixels in a record of the journal; pixels between the first and the last may be missing from it.
  struct Piece {
    std::uint32_t first = 0, last = 0;
    io::Journal::Record record;
  };

  void require_same(const std::string& there, const std::string& of) const;
  void open_results();
  void take(const io::Journal::Record& record);
  void take_name(const io::Journal::Record& record);
  void take_pixels(const io::Journal::Record& record);
  [[noreturn]] void refuse_part() const;
  void keep(io::Journal::Record record, const void* payload, std::size_t bytes);
  void visit(const Piece& piece, const std::function<void(std::uint32_t, const SlicePixel&)>& visit) const;

  const std::string path_;
  const io::SliceFileHeader header_;
  const std::uint64_t size_;  // of the map, in pixels
  io::Journal journal_;
  std::optional<io::SliceReader> file_;
  std::vector<OutcomeShare> codes_;
  std::vector<std::vector<double>> discoveries_;
  std::vector<Piece> pieces_;
  std::unique_ptr<SearchLog> notes_;
};

}  // namespace equipoise
