// SPDX-License-Identifier: MIT
#include "papers/hybrid/procedures.hpp"

#include <vector>

#include "papers/hybrid/box.hpp"
#include "papers/hybrid/complete_case.hpp"
#include "papers/hybrid/order.hpp"

namespace boxstream::papers {

namespace {

using Boxes = std::vector<NumberedBox>;
using Seen = Span<const NumberedBox>;

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
  Boxes intervals = numbered(boxes), points = intervals;
  run_complete(procedure, Structures{}, SortToScan{}, Span<NumberedBox>(intervals), Span<NumberedBox>(points), options,
               found);
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
      stream(procedure, search, Span<NumberedBox>(a), Span<NumberedBox>(b), View::first);
      return stream(procedure, search, Span<NumberedBox>(b), Span<NumberedBox>(a), View::second);
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
