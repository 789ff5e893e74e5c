// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/inputs.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

namespace {

/// What the trees of section 3 would hold if they were kept: a node for each that is streamed, and a place in a list,
/// four bytes, for each box that a list in the last dimension has. Boxes of either set are in these lists as often as
/// they are looked up in them: half of all are those that are stored.
struct Kept {
  std::size_t nodes = 0, places = 0;

  explicit Kept(const TreeTrace& trace) {
    for (const TreeTrace::Entry& entry : trace.entries()) {
      nodes += entry.node == Node::streamed ? 1 : 0;
      places += entry.node == Node::scanned ? (entry.intervals + entry.points + 1) / 2 : 0;
    }
  }
};

constexpr std::size_t bytes_of_node = 16, bytes_of_place = sizeof(Pointer);

}  // namespace

/// Section 3, "the space requirements are prohibitive": of two levels of trees, with lists in the last dimension, which
/// is what Stream2-Scan goes through.
Outcome trees_in_memory(const Settings& settings) {
  Outcome outcome;
  outcome.table.columns = {"boxes",           "nodes",     "places a box", "bytes a box",
                           "Stream2-Scan ms", "Hybrid ms", "engine ms"};
  for (const std::size_t n :
       settings.quick ? std::vector<std::size_t>{500, 2000} : std::vector<std::size_t>{5'000, 20'000, 80'000}) {
    settings.progress(fmt::format("{} boxes", n));
    const BipartiteInput input = make_bipartite("U", n, settings.seed);
    HybridOptions streamed, hybrid;
    streamed.cutoffs = Cutoffs(0);
    const auto search = [&](const HybridOptions& options, Found found) {
      VersionThree(Span<const Box>(input.a.boxes), Span<const Box>(input.b.boxes)).find_pairs(options, found);
    };
    TreeTrace trace;
    VersionThree(Span<const Box>(input.a.boxes), Span<const Box>(input.b.boxes))
        .find_pairs(
            streamed, [](std::uint32_t, std::uint32_t) {}, trace);
    const Kept kept(trace);
    const Measured engine = measure_engine(settings.repeats, input.a.closed, input.b.closed);
    const std::vector<Measured> times =
        measure_interleaved(settings.repeats, {{"Stream2-Scan", [&](Found found) { search(streamed, found); }},
                                               {"Hybrid", [&](Found found) { search(hybrid, found); }}});
    require_same(times[0].found, engine.found, "Stream2-Scan");
    const auto a_box = [n](std::size_t number) { return static_cast<double>(number) / static_cast<double>(n); };
    outcome.table.rows.push_back(
        {std::to_string(n), std::to_string(kept.nodes), fmt::format("{:.1f}", a_box(kept.places)),
         fmt::format("{:.0f}", a_box(kept.nodes * bytes_of_node + kept.places * bytes_of_place)),
         fmt::format("{:.1f}", times[0].ms), fmt::format("{:.1f}", times[1].ms), fmt::format("{:.2f}", engine.ms)});
  }
  outcome.findings.push_back("streamed, a box takes 28 bytes");
  return outcome;
}

}  // namespace boxstream::papers
