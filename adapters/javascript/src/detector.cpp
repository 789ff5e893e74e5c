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
};

void answer_with_search(const Search& search, const Stats& stats) {
  answer.parts[0] = {search.pairs.data(), static_cast<std::uint32_t>(search.pairs.size())};
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

/// `of_two`: between `a` and `b`. Filters are null, or one for each box.
BOXSTREAM_EXPORT(findPairs)
Status boxstream_javascript_find_pairs(Search* search, Scalar scalar, const void* a, std::size_t a_count,
                                       const void* a_filters, bool of_two, const void* b, std::size_t b_count,
                                       const void* b_filters) {
  return guarded([&] {
    with_scalar(scalar, [&](auto s) {
      using Box = boxstream::BasicAabb<decltype(s)>;
      using boxstream::Filter;
      const auto boxes = view<Box>(a, a_count);
      const auto filters = view_or_none<Filter>(a_filters, a_count);
      const auto stats = of_two ? search->detector.find_pairs(boxes, view<Box>(b, b_count), search->pairs, filters,
                                                              view_or_none<Filter>(b_filters, b_count))
                                : search->detector.find_pairs(boxes, search->pairs, filters);
      answer_with_search(*search, stats);
    });
  });
}
