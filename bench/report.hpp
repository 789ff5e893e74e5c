// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "machine.hpp"

namespace boxstream::bench {

/// One comparison: ours against one peer on one case.
struct Row {
  std::string suite;
  std::string case_name;
  std::size_t n = 0;
  std::string peer;
  std::uint64_t k = 0;              ///< pairs
  double ours_ms = 0, peer_ms = 0;  ///< medians
  double ours_min = 0, peer_min = 0;
  bool pairs_equal = false;
  unsigned threads = 1;
  std::string clock = "cpu";  ///< "cpu": of the thread; "wall": elapsed
  std::string note;           ///< what a reader should know about the times
  std::string skipped;        ///< why the peer did not run; then its times mean nothing

  double ratio() const { return ours_ms > 0 ? peer_ms / ours_ms : 0; }
  bool failed() const { return skipped.empty() && !pairs_equal; }
};

/// Prints rows as they come and keeps them for the JSON file.
class Report {
 public:
  explicit Report(Machine machine);

  void add(Row row);

  /// True if some peer and ours found different pairs.
  bool failed() const;

  /// Throws std::runtime_error when the file cannot be written.
  void write_json(const std::string& path) const;

 private:
  Machine machine_;
  std::vector<Row> rows_;
};

}  // namespace boxstream::bench
