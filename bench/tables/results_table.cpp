// SPDX-License-Identifier: MIT
#include "tables/results_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/output_file.hpp"
#include "base/read_file.hpp"

namespace boxstream::bench {

namespace {

std::optional<FrameTimes> frames_from(const nlohmann::json& json, const char* name) {
  if (!json.contains(name)) return std::nullopt;
  const nlohmann::json& frames = json.at(name);
  return FrameTimes{frames.at("median"), frames.at("p99"), frames.at("worst")};
}

Row row_from(const nlohmann::json& json) {
  const nlohmann::json equal = json.value("pairs_equal", nlohmann::json());
  return {.suite = json.at("suite"),
          .case_name = json.at("case"),
          .n = json.at("n"),
          .peer = json.at("peer"),
          .k = json.at("k"),
          .ours_ms = json.at("ours_ms"),
          .peer_ms = json.value("peer_ms", 0.0),
          .ours_min = json.at("ours_min"),
          .peer_min = json.value("peer_min", 0.0),
          .pairs_equal = equal.is_boolean() ? std::optional(equal.get<bool>()) : std::nullopt,
          .yardstick = json.value("yardstick", false),
          .threads = json.at("threads"),
          .clock = json.at("clock"),
          .scratch_bytes = json.value("scratch_bytes", std::size_t{0}),
          .ours_frames = frames_from(json, "ours_frames_ms"),
          .peer_frames = frames_from(json, "peer_frames_ms"),
          .note = json.value("note", ""),
          .known_difference = json.value("known_difference", ""),
          .skipped = json.value("skipped", "")};
}

/// The cases in which a peer is faster, worst first: "`users` crowd:self, 12: 0.73; ...".
std::string slower_cases(std::vector<Best> best) {
  const auto faster = [](const Best& each) { return each.row->ratio() >= 1; };
  const std::size_t cases = best.size();
  std::erase_if(best, faster);
  if (best.empty()) return fmt::format("In none of {} cases a peer is faster.\n\n", cases);
  std::stable_sort(best.begin(), best.end(),
                   [](const Best& a, const Best& b) { return a.row->ratio() < b.row->ratio(); });
  std::string text;
  for (const Best& each : best)
    text += fmt::format("{}`{}` {}, {}: {:.2f}", text.empty() ? "" : "; ", each.row->suite, each.row->case_name,
                        each.row->n, each.row->ratio());
  return fmt::format("In {} of {} cases a peer is faster, worst first: {}.\n\n", best.size(), cases, text);
}

}  // namespace

ResultsFile read_results(const std::string& json_path) {
  std::ifstream file(json_path);
  if (!file) throw std::runtime_error("cannot read " + json_path);
  try {
    const nlohmann::json document = nlohmann::json::parse(file);
    const nlohmann::json& machine = document.at("machine");
    const auto text = [&](const char* key) { return machine.value(key, "unknown"); };
    ResultsFile results;
    results.machine = {text("cpu"),        machine.value("hardware_threads", 0U),
                       text("compiler"),   text("flags"),
                       text("peer_flags"), text("simd"),
                       text("date"),       0,
                       text("boxstream"),  text("commit")};
    for (const nlohmann::json& row : document.at("rows")) results.rows.push_back(row_from(row));
    return results;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(fmt::format("{} is not a file of benchmark rows: {}", json_path, error.what()));
  }
}

std::string describe_run(const Machine& machine) {
  const std::string sources = machine.commit.empty() ? "" : fmt::format("sources at {}; ", machine.commit);
  return fmt::format("{}, {} hardware threads; {}, `{}`, peers `{}`; SIMD target {}; {}{}", machine.cpu,
                     machine.hardware_threads, machine.compiler, machine.flags, machine.peer_flags, machine.simd,
                     sources, machine.date.substr(0, 10));
}

std::string results_table(const std::vector<Row>& rows) {
  std::string text;
  const std::vector<Best> best = best_peers(rows);
  if (!best.empty()) {
    text += slower_cases(best) +
            "| suite | case | n | threads | pairs | ours, ms | best peer | its ms | ratio | of peers |\n"
            "|---|---|--:|--:|--:|--:|---|--:|--:|--:|\n";
    for (const auto& [row, peers] : best)
      text +=
          fmt::format("| {} | {} | {} | {} | {} | {:.4g} | {} | {:.4g} | {:.2f} | {} |\n", row->suite, row->case_name,
                      row->n, row->threads, row->k, row->ours_ms, row->peer, row->peer_ms, row->ratio(), peers);
  }
  std::string yardsticks;
  for (const Row& row : rows)
    if (row.yardstick && row.skipped.empty() && row.peer != "hybrid")
      yardsticks += fmt::format("| {} | {} | {} | {} | {:.4g} | {} | {:.4g} | {:.2f} |\n", row.suite, row.case_name,
                                row.n, row.threads, row.ours_ms, row.peer, row.peer_ms, row.ratio());
  if (!yardsticks.empty())
    text +=
        "\nYardsticks are no peers: a sort alone, or ours in another way.\n\n| suite | case | n | threads | ours, ms | "
        "yardstick | its ms | ratio |\n|---|---|--:|--:|--:|---|--:|--:|\n" +
        yardsticks;
  return text;
}

std::string frames_table(const std::vector<Row>& rows) {
  std::string text =
      "| case | n | ours, us: median, 99 %, worst | worst / median | least worst of a peer | its median, worst | "
      "worst / median |\n|---|--:|--:|--:|---|--:|--:|\n";
  std::vector<const Row*> least;  // of each case
  for (const Row& row : rows) {
    if (!row.ours_frames || !row.peer_frames || row.yardstick || !row.skipped.empty()) continue;
    const auto of_case = std::find_if(least.begin(), least.end(), [&](const Row* other) {
      return other->suite == row.suite && other->case_name == row.case_name && other->n == row.n;
    });
    if (of_case == least.end())
      least.push_back(&row);
    else if (row.peer_frames->worst < (*of_case)->peer_frames->worst)
      *of_case = &row;
  }
  for (const Row* row : least) {
    const FrameTimes &ours = *row->ours_frames, &peer = *row->peer_frames;
    text +=
        fmt::format("| {} | {} | {:.4g}, {:.4g}, {:.4g} | {:.1f} | {} | {:.4g}, {:.4g} | {:.1f} |\n", row->case_name,
                    row->n, 1000 * ours.median, 1000 * ours.p99, 1000 * ours.worst, ours.worst / ours.median, row->peer,
                    1000 * peer.median, 1000 * peer.worst, peer.worst / peer.median);
  }
  return least.empty() ? "" : text;
}

std::string put_block(const std::string& page, const std::string& name, const std::string& text) {
  const std::string begin_mark = fmt::format("<!-- {}: begin -->\n", name),
                    end_mark = fmt::format("<!-- {}: end -->", name);
  const std::size_t begin = page.find(begin_mark), end = page.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error(
        fmt::format("the page has no lines {} and {}", begin_mark.substr(0, begin_mark.size() - 1), end_mark));
  return page.substr(0, begin + begin_mark.size()) + text + page.substr(end);
}

void put_or_print(const std::string& path, const std::string& name, const std::string& text) {
  if (path.empty()) {
    fmt::print("{}", text);
    return;
  }
  const std::string old = files::read_file(path, files::most_of_text);
  files::write_file(path, put_block(old, name, text), files::Input::may_change);
}

}  // namespace boxstream::bench
