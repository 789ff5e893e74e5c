// SPDX-License-Identifier: MIT
#include "papers/hybrid/procedures.hpp"

#include <vector>

#include "papers/hybrid/access.hpp"
#include "papers/hybrid/hybrid.hpp"
#include "papers/hybrid/order.hpp"
#include "papers/hybrid/stream3.hpp"

namespace boxstream::papers {

namespace {

using Boxes = std::vector<NumberedBox>;
using Seen = Span<const NumberedBox>;

/// The one that a streamed procedure begins with: the root of its tree.
template <class Search>
void stream(Procedure procedure, Search& search, Span<NumberedBox> i, Span<NumberedBox> p, View view) {
  if (procedure == Procedure::stream3) return stream3(search, i, p, minus_infinity, plus_infinity, 2, view);
  if (procedure == Procedure::stream2_scan) search.options.cutoffs = Cutoffs(0);
  hybrid(search, i, p, minus_infinity, plus_infinity, 2, view);
}

}  // namespace

Span<const Procedure> procedures() {
  static constexpr Procedure all[] = {
      Procedure::all_pairs, Procedure::one_way_scan, Procedure::two_way_scan, Procedure::modified_two_way_scan,
      Procedure::stream3,   Procedure::stream2_scan, Procedure::hybrid};
  return all;
}

std::string_view name(Procedure procedure) {
  switch (procedure) {
    case Procedure::all_pairs:
      return "AllPairs";
    case Procedure::one_way_scan:
      return "OneWayScan";
    case Procedure::two_way_scan:
      return "TwoWayScan";
    case Procedure::modified_two_way_scan:
      return "ModifiedTwoWayScan";
    case Procedure::stream3:
      return "Stream3";
    case Procedure::stream2_scan:
      return "Stream2-Scan";
    case Procedure::hybrid:
      break;
  }
  return "Hybrid";
}

void run(Procedure procedure, Span<const Box> boxes, const HybridOptions& options, Found found) {
  using Complete = Problem<Structures>;
  Boxes set = numbered(boxes);
  switch (procedure) {
    case Procedure::all_pairs:
      return all_pairs(Complete({}, Case::bipartite, 0, found), Seen(set));
    case Procedure::one_way_scan: {
      const Complete problem({}, Case::complete, 0, found);
      sort_by_low_end(problem, Span<NumberedBox>(set));
      return one_way_scan(problem, Seen(set), Seen(set), 2, View::first);
    }
    case Procedure::two_way_scan: {
      // Each pair comes from both sides, and each box with itself.
      const auto once = [&](std::uint32_t a, std::uint32_t b) {
        if (a < b) found(a, b);
      };
      const Complete problem({}, Case::bipartite, 0, once);
      sort_by_low_end(problem, Span<NumberedBox>(set));
      return two_way_scan(problem, Seen(set), Seen(set), 2);
    }
    case Procedure::modified_two_way_scan: {
      const Complete problem({}, Case::complete, 2, found);
      sort_by_low_end(problem, Span<NumberedBox>(set));
      return modified_two_way_scan(problem, Seen(set), Seen(set), 2, View::first);
    }
    case Procedure::stream3:
    case Procedure::stream2_scan:
    case Procedure::hybrid: {
      Boxes points = set;
      Search<Complete, SortToScan> search{Complete({}, Case::complete, 2, found), {}, options};
      return stream(procedure, search, set, points, View::first);
    }
  }
}

void run(Procedure procedure, Span<const Box> first, Span<const Box> second, const HybridOptions& options,
         Found found) {
  using Bipartite = Problem<Structures>;
  const Bipartite problem({}, Case::bipartite, 0, found);
  Boxes a = numbered(first), b = numbered(second);
  switch (procedure) {
    case Procedure::all_pairs:
      return all_pairs(problem, Seen(a), Seen(b));
    case Procedure::stream3:
    case Procedure::stream2_scan:
    case Procedure::hybrid: {
      Search<Bipartite, SortToScan> search{problem, {}, options};
      stream(procedure, search, a, b, View::first);
      return stream(procedure, search, b, a, View::second);
    }
    case Procedure::one_way_scan:
    case Procedure::two_way_scan:
    case Procedure::modified_two_way_scan:
      break;
  }
  sort_by_low_end(problem, Span<NumberedBox>(a));
  sort_by_low_end(problem, Span<NumberedBox>(b));
  if (procedure == Procedure::two_way_scan) return two_way_scan(problem, Seen(a), Seen(b), 2);
  const auto scan = [&](const Boxes& intervals, const Boxes& points, View view) {
    if (procedure == Procedure::one_way_scan) return one_way_scan(problem, Seen(intervals), Seen(points), 2, view);
    modified_two_way_scan(problem, Seen(intervals), Seen(points), 2, view);
  };
  scan(a, b, View::first);
  scan(b, a, View::second);
}

}  // namespace boxstream::papers
