// SPDX-License-Identifier: MIT
#include "tables/report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/output_file.hpp"

namespace boxstream::bench {

namespace {

std::string verdict(const Row& row) {
  if (!row.pairs_equal) return "-";
  if (*row.pairs_equal) return "equal";
  return row.failed() ? "FAIL: differ" : fmt::format("differ: {}", row.known_difference);
}

nlohmann::ordered_json to_json(const Row& row, const std::string& simd) {
  nlohmann::ordered_json json = {
      {"suite", row.suite},     {"case", row.case_name},   {"n", row.n}, {"peer", row.peer}, {"k", row.k},
      {"ours_ms", row.ours_ms}, {"ours_min", row.ours_min}};
  if (row.skipped.empty()) {
    json["peer_ms"] = row.peer_ms;
    json["peer_min"] = row.peer_min;
    json["ratio"] = row.ratio();
    json["pairs_equal"] = row.pairs_equal ? nlohmann::ordered_json(*row.pairs_equal) : nullptr;
    if (row.pairs_equal == false && !row.known_difference.empty()) json["known_difference"] = row.known_difference;
  } else {
    json["skipped"] = row.skipped;
  }
  if (row.yardstick) json["yardstick"] = true;
  json["threads"] = row.threads;
  json["clock"] = row.clock;
  json["simd"] = simd;
  if (row.samples > 0) json["samples"] = row.samples;
  if (row.scratch_bytes > 0) json["scratch_bytes"] = row.scratch_bytes;
  const auto put_frames = [&](const char* name, const std::optional<FrameTimes>& frames) {
    if (frames) json[name] = {{"median", frames->median}, {"p99", frames->p99}, {"worst", frames->worst}};
  };
  put_frames("ours_frames_ms", row.ours_frames);
  put_frames("peer_frames_ms", row.peer_frames);
  if (!row.note.empty()) json["note"] = row.note;
  return json;
}

std::string said_of_frames(const Row& row) {
  if (!row.ours_frames || !row.peer_frames) return "";
  const FrameTimes &ours = *row.ours_frames, &peer = *row.peer_frames;
  return fmt::format("; frames 50 % 99 % worst: {:.3g} {:.3g} {:.3g}, peer {:.3g} {:.3g} {:.3g}", ours.median, ours.p99,
                     ours.worst, peer.median, peer.p99, peer.worst);
}

}  // namespace

std::vector<Best> best_peers(const std::vector<Row>& rows) {
  std::vector<Best> best;
  std::map<std::tuple<std::string, std::string, std::size_t, unsigned>, std::size_t> places;
  for (const Row& row : rows) {
    if (!row.skipped.empty() || row.yardstick) continue;
    const auto [place, is_new] = places.try_emplace({row.suite, row.case_name, row.n, row.threads}, best.size());
    if (is_new) {
      best.push_back({&row, 1});
      continue;
    }
    Best& known = best[place->second];
    ++known.peers;
    if (row.ratio() < known.row->ratio()) known.row = &row;
  }
  return best;
}

Report::Report(Machine machine) : machine_(std::move(machine)) {
  machine_.peer_flags += BOXSTREAM_BENCH_PEER_OPTIONS;
  fmt::print("boxstream {}, {}, {} hardware threads, load {:.2f}, {}\n", machine_.version, machine_.cpu,
             machine_.hardware_threads, machine_.load, machine_.date);
  fmt::print("{}; flags: {}; peers: {}; SIMD target: {}\n", machine_.compiler, machine_.flags, machine_.peer_flags,
             machine_.simd);
  fmt::print("medians of interleaved runs, in milliseconds; clock: of the thread (cpu) or on the wall\n\n");
}

void Report::add(Row row) {
  if (row.peer == "hybrid") row.yardstick = true;  // ours as well
  if (rows_.empty())
    fmt::print("{:<7} {:<10} {:>8} {:>9} {:<18} {:>9} {:>9} {:>7} {:>9} {:>9} {:>2} {:<4}  {}\n", "suite", "case", "n",
               "pairs", "peer", "ours", "peer", "ratio", "ours min", "peer min", "th", "clk", "pairs");
  fmt::print("{:<7} {:<10} {:>8} {:>9} {:<18} {:>9.4g} ", row.suite, row.case_name, row.n, row.k, row.peer,
             row.ours_ms);
  const std::string where = fmt::format("{:>2} {:<4}", row.threads, row.clock);
  if (row.skipped.empty())
    fmt::print("{:>9.4g} {:>7.2f} {:>9.4g} {:>9.4g} {}  {}{}{}{}\n", row.peer_ms, row.ratio(), row.ours_min,
               row.peer_min, where, verdict(row), said_of_frames(row), row.note.empty() ? "" : "; ", row.note);
  else
    fmt::print("{:>9} {:>7} {:>9.4g} {:>9} {}  skipped: {}\n", "-", "-", row.ours_min, "-", where, row.skipped);
  std::fflush(stdout);
  rows_.push_back(std::move(row));
}

void Report::print_summary() const {
  const std::vector<Best> best = best_peers(rows_);
  if (best.empty()) return;
  fmt::print("\nbest peer of each case\n{:<7} {:<10} {:>8} {:>2} {:>9}  {:<18} {:>7} {:>6}\n", "suite", "case", "n",
             "th", "ours", "best peer", "ratio", "peers");
  for (const auto& [row, peers] : best)
    fmt::print("{:<7} {:<10} {:>8} {:>2} {:>9.4g}  {:<18} {:>7.2f} {:>6}\n", row->suite, row->case_name, row->n,
               row->threads, row->ours_ms, row->peer, row->ratio(), peers);
}

bool Report::failed() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.failed(); });
}

void Report::write_json(const std::string& path) const {
  nlohmann::ordered_json document;
  document["machine"] = measure::to_json(machine_);
  document["rows"] = nlohmann::ordered_json::array();
  for (const Row& row : rows_) document["rows"].push_back(to_json(row, machine_.simd));
  files::write_file(path, document.dump(2) + "\n");
}

}  // namespace boxstream::bench
