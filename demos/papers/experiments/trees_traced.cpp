// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/inputs.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

namespace {

const char* name(Node node) {
  switch (node) {
    case Node::streamed:
      return "streamed";
    case Node::cut_off:
      return "cut off";
    case Node::scanned:
      break;
  }
  return "scanned";
}

/// The paper's colours, but for scans of dimension 0, which it does not show.
picture::Colour colour(const TreeTrace::Entry& entry) {
  if (entry.node == Node::scanned) return {0.83F, 0.18F, 0.09F};
  if (entry.node == Node::cut_off)
    return entry.dimension == 2 ? picture::Colour{0, 0, 0} : picture::Colour{0.6F, 0.6F, 0.6F};
  return entry.dimension == 2 ? picture::Colour{1, 1, 1} : picture::Colour{0.75F, 0.85F, 0.95F};
}

/// The first of the two trees that a search streams, alone.
std::vector<TreeTrace::Entry> first_tree(const TreeTrace& trace) {
  const auto& all = trace.entries();
  const auto second =
      std::find_if(all.begin() + 1, all.end(), [](const auto& e) { return e.parent == TreeTrace::none; });
  return {all.begin(), second};
}

}  // namespace

/// Of 50 000 boxes, as the paper says, in each of the two sets: with as many in both together no interval spans a node
/// of more than 750 points. A node with c points is about 2 c wide, and the longest interval is n^(2/3), so that the
/// second level begins to be used below c = n^(2/3) / 2: 1077 here, just above the larger of the paper's two cutoffs.
Outcome figure_9(const Settings& settings) {
  const std::size_t n = settings.quick ? 4000 : 100'000;
  const std::vector<std::size_t> cutoffs =
      settings.quick ? std::vector<std::size_t>{200, 100} : std::vector<std::size_t>{1000, 750};
  const BipartiteInput input = make_bipartite("U", n, settings.seed);
  const Measured engine = measure_engine(settings.repeats, input.a.closed, input.b.closed);
  Outcome outcome;
  outcome.table.columns = {"cutoff", "node", "parent", "kind", "dimension", "intervals", "points", "spanning"};
  for (const std::size_t c : cutoffs) {
    settings.progress(fmt::format("cutoff {}", c));
    HybridOptions options;
    options.cutoffs = Cutoffs(c);
    PairSum found;
    TreeTrace trace;
    VersionThree(Span<const Box>(input.a.boxes), Span<const Box>(input.b.boxes))
        .find_pairs(
            options, [&](std::uint32_t a, std::uint32_t b) { found.add(a, b); }, trace);
    require_same(found, engine.found, "Version Three");
    const std::vector<TreeTrace::Entry> tree = first_tree(trace);
    picture::TreeDrawing drawing;
    std::size_t second_level = 0, spanning = 0;
    for (std::size_t at = 0; at < tree.size(); ++at) {
      const TreeTrace::Entry& e = tree[at];
      outcome.table.rows.push_back({std::to_string(c), std::to_string(at), at == 0 ? "" : std::to_string(e.parent),
                                    name(e.node), std::to_string(e.dimension), std::to_string(e.intervals),
                                    std::to_string(e.points), std::to_string(e.spanning)});
      second_level += e.dimension < 2;
      spanning += e.spanning > 0;
      drawing.nodes.push_back({at == 0 ? 0 : e.parent, colour(e)});
    }
    drawing.title = fmt::format("Figure 9: the first tree streamed for {} boxes in each set, cutoff {}", n / 2, c);
    drawing.keys = {{{1, 1, 1}, "first level"},
                    {{0, 0, 0}, "cut off"},
                    {{0.75F, 0.85F, 0.95F}, "second level"},
                    {{0.6F, 0.6F, 0.6F}, "cut off"},
                    {{0.83F, 0.18F, 0.09F}, "scanned"}};
    outcome.trees.push_back(drawing);
    outcome.findings.push_back(fmt::format("cutoff {}: {} nodes with spanning intervals, {} calls at the second level",
                                           c, spanning, second_level));
  }
  return outcome;
}

}  // namespace boxstream::papers
