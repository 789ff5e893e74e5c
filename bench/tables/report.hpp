// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tables/measuring.hpp"

namespace boxstream::bench {

/// Of all frames of a run, one by one: a user sees the worst ones. Milliseconds.
struct FrameTimes {
  double median = 0, p99 = 0, worst = 0;
};

/// One comparison: ours against one peer on one case.
struct Row {
  std::string suite{};
  std::string case_name{};
  std::size_t n = 0;
  std::string peer{};
  std::uint64_t k = 0;              ///< pairs
  double ours_ms = 0, peer_ms = 0;  ///< medians
  double ours_min = 0, peer_min = 0;
  std::optional<bool> pairs_equal = false;  ///< empty where no pairs are found
  bool yardstick = false;                   ///< not a competitor: a sort, ours on one thread, or by the paper's tree
  unsigned threads = 1;                     ///< of ours, and of the peer if it can
  std::string clock = "cpu";                ///< "cpu": of the thread; "wall": elapsed
  std::size_t samples = 0;                  ///< that the peer's median is taken of; 0: not counted
  std::size_t scratch_bytes = 0;            ///< of ours, beyond input and output; 0: not counted
  std::optional<FrameTimes> ours_frames{}, peer_frames{};
  std::string note{};              ///< about the times
  std::string known_difference{};  ///< why the peer's pairs may differ from ours
  std::string skipped{};           ///< why the peer did not run; then it has no times

  void set_ours(const Series& series) {
    ours_ms = series.median;
    ours_min = series.min;
  }
  void set_peer(const Series& series) {
    peer_ms = series.median;
    peer_min = series.min;
    samples = series.samples;
  }

  double ratio() const { return ours_ms > 0 ? peer_ms / ours_ms : 0; }
  bool failed() const { return skipped.empty() && pairs_equal == false && known_difference.empty(); }
};

/// The yardstick of suite scaling that is no peer: what of a search, itself timed as ours, is done outside of tasks.
inline constexpr const char* serial_share = "serial-share";

/// The best peer of a case: the row with the smallest ratio.
struct Best {
  const Row* row;
  std::size_t peers;  ///< that ran
};

/// For each suite, case, n and number of threads among `rows`, in their order; yardsticks do not compete.
std::vector<Best> best_peers(const std::vector<Row>& rows);

/// Prints rows as they come and keeps them for the JSON file.
class Report {
 public:
  explicit Report(Machine machine);

  void add(Row row);

  const std::vector<Row>& rows() const { return rows_; }

  /// A line for each case: the best peer, and how it compares.
  void print_summary() const;

  /// True if the pairs of some peer differ from ours for no known reason.
  bool failed() const;

  /// Throws std::runtime_error when the file cannot be written.
  void write_json(const std::string& path) const;

 private:
  Machine machine_;
  std::vector<Row> rows_;
};

}  // namespace boxstream::bench
