// SPDX-License-Identifier: MIT
// Looks for sizes and histories at which a public call suddenly takes longer, or longer than a peer.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cliffs/search.hpp"
#include "measure/machine.hpp"
#include "measure/progress.hpp"

using namespace boxstream::bench;

namespace {

std::vector<CliffCall> all_calls() {
  std::vector<CliffCall> calls = world_calls();
  const auto take = [&](std::vector<CliffCall> more) { calls.insert(calls.end(), more.begin(), more.end()); };
  take(detector_calls());
#ifdef BOXSTREAM_BENCH_CLIFFS_BULLET
  take(bullet_calls());
#endif
#ifdef BOXSTREAM_BENCH_CLIFFS_FCL
  take(fcl_calls());
#endif
  return calls;
}

nlohmann::ordered_json to_json(const CliffRow& row) {
  nlohmann::ordered_json cliffs = nlohmann::ordered_json::array();
  for (const Cliff& cliff : row.cliffs)
    cliffs.push_back({{"history", cliff.history},
                      {"from", cliff.from},
                      {"to", cliff.to},
                      {"worst", cliff.worst},
                      {"jump", cliff.jump},
                      {"below", cliff.below}});
  nlohmann::ordered_json json = {{"owner", row.owner},
                                 {"name", row.name},
                                 {"description", row.description},
                                 {"equal", row.equal},
                                 {"largest_jump", row.largest_jump},
                                 {"jump_from", row.jump_from},
                                 {"jump_to", row.jump_to},
                                 {"jump_history", row.jump_history},
                                 {"cliffs", cliffs}};
  if (row.least < 1e9) {
    json["least"] = row.least;
    json["least_at"] = row.least_at;
    json["least_history"] = row.least_history;
    for (const CliffPoint& point : row.fresh) json["fresh"].push_back({point.n, point.ratio()});
  }
  return json;
}

std::string footer(const std::vector<CliffCall>& calls) {
  std::string text = "Calls:\n";
  for (const CliffCall& call : calls)
    text += fmt::format("  {:<8} {:<18} {}{}\n", call.owner, call.name, call.description,
                        call.make_peer != nullptr ? ", beside a peer" : "");
  return text +
         "Peers: btDbvtBroadphase, and FCL's DynamicAABBTreeCollisionManager.\n"
         "Exit code: 0; 1: some pairs or answers differ from the peer's; 2: bad arguments";
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<CliffCall> calls = all_calls();
  CLI::App app(
      "Measures each public call at many sizes and after several histories, and says where the time per box and pair "
      "jumps between neighbours, or is more than that of a peer. Each such place is measured again.");
  app.footer(footer(calls));
  std::size_t by_one = 200, most = 100000;
  double step = 1.1, jump = 1.5;
  bool quick = false;
  std::string json, only;
  app.add_flag("--quick", quick, "sizes by a fifth from 10 on, up to 3000: half a minute");
  app.add_option("--by-one", by_one, "sizes one by one up to this")->capture_default_str();
  app.add_option("--step", step, "then by this factor")->check(CLI::Range(1.01, 10.0))->capture_default_str();
  app.add_option("--most", most, "largest size")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--jump", jump, "what is reported")->capture_default_str();
  app.add_option("--call", only, "only calls whose OWNER: NAME contains this");
  app.add_option("--json", json, "write what is found to this file");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (quick) {
    by_one = 10;
    step = 1.2;
    most = 3000;
  }
  const std::vector<std::size_t> sizes = cliff_sizes(by_one, step, most);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  boxstream::measure::Progress progress;
  bool equal = true;
  for (const CliffCall& call : calls) {
    if ((call.owner + ": " + call.name).find(only) == std::string::npos) continue;
    const CliffRow row = search_cliffs(call, sizes, jump, [&](const std::string& what) { progress.show(what); });
    progress.clear();
    equal = equal && row.equal;
    fmt::print("{:<8} {:<18} largest jump {:5.2f} ({} to {}, {})", row.owner, row.name, row.largest_jump, row.jump_from,
               row.jump_to, row.jump_history);
    if (row.least < 1e9) fmt::print("; least of the peer {:5.2f} ({}, {})", row.least, row.least_at, row.least_history);
    fmt::print("{}\n", row.equal ? "" : "  ANSWERS DIFFER");
    for (const Cliff& cliff : row.cliffs)
      if (cliff.jump > 0)
        fmt::print("    {} to {}, {}: {:.2f} times per box and pair\n", cliff.from, cliff.to, cliff.history,
                   cliff.jump);
      else
        fmt::print("    {} to {}, {}: {:.2f} of the peer's speed at {}\n", cliff.from, cliff.to, cliff.history,
                   cliff.below, cliff.worst);
    std::fflush(stdout);
    rows.push_back(to_json(row));
  }
  if (!json.empty()) {
    nlohmann::ordered_json file = {{"machine", boxstream::measure::to_json(boxstream::measure::describe_machine())},
                                   {"sizes", {{"by_one", by_one}, {"step", step}, {"most", most}, {"jump", jump}}},
                                   {"rows", rows}};
    std::ofstream(json) << file.dump(1) << '\n';
  }
  return equal ? 0 : 1;
}
