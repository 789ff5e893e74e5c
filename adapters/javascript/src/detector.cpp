// SPDX-License-Identifier: MIT
#include <boxstream/detector.hpp>

#include "answer.hpp"
#include "views.hpp"

namespace boxstream::javascript {
namespace {

/// Its pairs are read where they lie: they are kept, so that searches of the same size need no memory.
struct Search {
  Search(bool is_hybrid, std::uint32_t cutoff)
      : detector({nullptr, is_hybrid ? Method::hybrid : Method::planned, cutoff}) {}

  Detector detector;
  std::vector<Pair> pairs;
  Neighbours neighbours;
};

/// One set of boxes, with a filter and an id for each of them, or null.
struct Set {
  const void* boxes;
  std::size_t count;
  const void *filters, *ids;
};

PairRules rules_of(const Set& a, const Set& b, bool closed, double tolerance) {
  PairRules rules;
  rules.filters = view_or_none<Filter>(a.filters, a.count);
  rules.filters_b = view_or_none<Filter>(b.filters, b.count);
  rules.ids = view_or_none<std::uint32_t>(a.ids, a.count);
  rules.ids_b = view_or_none<std::uint32_t>(b.ids, b.count);
  rules.touching = closed;
  rules.tolerance = tolerance;
  return rules;
}

void answer_with_stats(const Stats& stats) {
  answer.numbers[0] = static_cast<double>(stats.boxes);
  answer.numbers[1] = static_cast<double>(stats.invalid);
  answer.numbers[2] = static_cast<double>(stats.pairs);
  answer.numbers[3] = static_cast<double>(stats.tests);
}

}  // namespace
}  // namespace boxstream::javascript

using namespace boxstream::javascript;

/// Answers with the address.
BOXSTREAM_EXPORT(createDetector) Status boxstream_create_detector(bool is_hybrid, std::uint32_t cutoff) {
  return guarded([&] { answer.parts[0] = {new Search(is_hybrid, cutoff)}; });
}

BOXSTREAM_EXPORT(destroyDetector) void boxstream_destroy_detector(Search* search) {
  delete search;
}

/// `of_two`: between `a` and `b`. Of the pairs there are two indices each.
BOXSTREAM_EXPORT(findPairs)
Status boxstream_javascript_find_pairs(Search* search, Scalar scalar, const void* a, std::size_t a_count,
                                       const void* a_filters, const void* a_ids, bool of_two, const void* b,
                                       std::size_t b_count, const void* b_filters, const void* b_ids, bool closed,
                                       double tolerance) {
  return guarded([&] {
    const auto rules = rules_of({a, a_count, a_filters, a_ids}, {b, b_count, b_filters, b_ids}, closed, tolerance);
    const auto boxes = boxes_of(scalar, a, a_count);
    std::vector<boxstream::Pair>& pairs = search->pairs;
    answer_with_stats(of_two ? search->detector.find_pairs(boxes, boxes_of(scalar, b, b_count), pairs, rules)
                             : search->detector.find_pairs(boxes, pairs, rules));
    answer.parts[0] = {pairs.data(), static_cast<std::uint32_t>(pairs.size())};
  });
}

/// The same as offsets and indices; `both`: each pair is in two rows.
BOXSTREAM_EXPORT(findNeighbours)
Status boxstream_javascript_find_neighbours(Search* search, Scalar scalar, const void* a, std::size_t a_count,
                                            const void* a_filters, const void* a_ids, bool of_two, const void* b,
                                            std::size_t b_count, const void* b_filters, const void* b_ids, bool closed,
                                            double tolerance, bool both) {
  return guarded([&] {
    const auto rules = rules_of({a, a_count, a_filters, a_ids}, {b, b_count, b_filters, b_ids}, closed, tolerance);
    const auto boxes = boxes_of(scalar, a, a_count);
    boxstream::Neighbours& found = search->neighbours;
    const auto directions = both ? boxstream::Directions::both : boxstream::Directions::one;
    answer_with_stats(of_two ? search->detector.find_neighbours(boxes, boxes_of(scalar, b, b_count), found, rules)
                             : search->detector.find_neighbours(boxes, found, rules, directions));
    if (found.indices.size() > UINT32_MAX) throw std::bad_alloc();
    give(0, std::vector<std::uint32_t>(found.offsets.begin(), found.offsets.end()));
    answer.parts[1] = {found.indices.data(), static_cast<std::uint32_t>(found.indices.size())};
  });
}
