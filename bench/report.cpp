// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace boxstream::bench {

Report::Report(Machine machine) : machine_(std::move(machine)) {
  fmt::print("boxstream {}, {}, {} hardware threads, load {:.2f}, {}\n", machine_.version, machine_.cpu,
             machine_.hardware_threads, machine_.load, machine_.date);
  fmt::print("{}; flags: {}; peers: {}; SIMD target: {}\n", machine_.compiler, machine_.flags, machine_.peer_flags,
             machine_.simd);
  fmt::print("medians of interleaved runs; batch: CPU time of the one thread, bullet: wall clock\n\n");
}

void Report::add(Row row) {
  if (rows_.empty())
    fmt::print("{:<7} {:<8} {:>9} {:>11} {:<16} {:>10} {:>10} {:>7} {:>10} {:>10}  {}\n", "suite", "case", "n", "pairs",
               "peer", "ours ms", "peer ms", "ratio", "ours min", "peer min", "pairs");
  fmt::print("{:<7} {:<8} {:>9} {:>11} {:<16} {:>10.4g} ", row.suite, row.case_name, row.n, row.k, row.peer,
             row.ours_ms);
  if (row.skipped.empty())
    fmt::print("{:>10.4g} {:>7.2f} {:>10.4g} {:>10.4g}  {}{}{}\n", row.peer_ms, row.ratio(), row.ours_min, row.peer_min,
               row.pairs_equal ? "equal" : "FAIL: differ", row.note.empty() ? "" : "; ", row.note);
  else
    fmt::print("{:>10} {:>7} {:>10.4g} {:>10}  skipped: {}\n", "-", "-", row.ours_min, "-", row.skipped);
  std::fflush(stdout);
  rows_.push_back(std::move(row));
}

bool Report::failed() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.failed(); });
}

void Report::write_json(const std::string& path) const {
  nlohmann::ordered_json document;
  document["machine"] = {{"cpu", machine_.cpu},
                         {"hardware_threads", machine_.hardware_threads},
                         {"compiler", machine_.compiler},
                         {"flags", machine_.flags},
                         {"peer_flags", machine_.peer_flags},
                         {"simd", machine_.simd},
                         {"date", machine_.date},
                         {"load", machine_.load},
                         {"boxstream", machine_.version}};
  document["rows"] = nlohmann::ordered_json::array();
  for (const Row& row : rows_) {
    nlohmann::ordered_json json = {
        {"suite", row.suite},     {"case", row.case_name},   {"n", row.n}, {"peer", row.peer}, {"k", row.k},
        {"ours_ms", row.ours_ms}, {"ours_min", row.ours_min}};
    if (row.skipped.empty()) {
      json["peer_ms"] = row.peer_ms;
      json["peer_min"] = row.peer_min;
      json["ratio"] = row.ratio();
      json["pairs_equal"] = row.pairs_equal;
    } else {
      json["skipped"] = row.skipped;
    }
    json["threads"] = row.threads;
    json["clock"] = row.clock;
    json["simd"] = machine_.simd;
    if (!row.note.empty()) json["note"] = row.note;
    document["rows"].push_back(std::move(json));
  }
  std::ofstream file(path);
  file << document.dump(2) << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace boxstream::bench
