// SPDX-License-Identifier: MIT
#include <boxstream/detector.hpp>

#include "c_executor.hpp"
#include "numbers.hpp"
#include "views.hpp"

struct boxstream_detector {
  boxstream_detector(const boxstream_executor* functions, boxstream_method method, std::uint32_t cutoff)
      : executor(boxstream::c::make_executor(functions)),
        detector({executor.get(), boxstream::c::method_of(method), cutoff}) {}

  std::unique_ptr<boxstream::Executor> executor;
  boxstream::Detector detector;
  std::vector<boxstream::Pair> pairs;
};

namespace boxstream::c {
namespace {

boxstream_stats counts_of(const Stats& stats) {
  return {sizeof(boxstream_stats), stats.boxes, stats.invalid, stats.pairs, stats.tests};
}

/// Calls `search(boxes, filters)` or `search(boxes, boxes, filters, filters)`, which gives Stats.
template <class Search>
Stats search_boxes(const boxstream_boxes& a, const boxstream_boxes* b, Search search) {
  if (b != nullptr && a.scalar != b->scalar) throw std::invalid_argument("two sets of different scalars");
  Stats stats;
  with_scalar(a.scalar, [&](auto scalar) {
    using S = decltype(scalar);
    stats = b == nullptr ? search(boxes_of<S>(a), filters_of(a))
                         : search(boxes_of<S>(a), boxes_of<S>(*b), filters_of(a), filters_of(*b));
  });
  return stats;
}

void give_pairs(const boxstream_detector& d, const boxstream_pair** pairs, std::size_t* count) {
  *pairs = reinterpret_cast<const boxstream_pair*>(d.pairs.data());
  *count = d.pairs.size();
}

/// How `Detector::find_pairs` and `stream_pairs` take their arguments: boxes, where to, filters.
struct Find {
  boxstream_detector& d;
  template <class Boxes>
  Stats operator()(Boxes boxes, Span<const Filter> filters) const {
    return d.detector.find_pairs(boxes, d.pairs, filters);
  }
  template <class Boxes>
  Stats operator()(Boxes a, Boxes b, Span<const Filter> filters_a, Span<const Filter> filters_b) const {
    return d.detector.find_pairs(a, b, d.pairs, filters_a, filters_b);
  }
};

struct Stream {
  boxstream_detector& d;
  PairSink sink;
  template <class Boxes>
  Stats operator()(Boxes boxes, Span<const Filter> filters) const {
    return d.detector.stream_pairs(boxes, sink, filters);
  }
  template <class Boxes>
  Stats operator()(Boxes a, Boxes b, Span<const Filter> filters_a, Span<const Filter> filters_b) const {
    return d.detector.stream_pairs(a, b, sink, filters_a, filters_b);
  }
};

}  // namespace
}  // namespace boxstream::c

using namespace boxstream::c;

boxstream_status boxstream_detector_create(const boxstream_executor* executor, boxstream_detector** out) {
  return boxstream_detector_create_with(executor, BOXSTREAM_PLANNED, 0, out);
}

boxstream_status boxstream_detector_create_with(const boxstream_executor* executor, boxstream_method method,
                                                uint32_t cutoff, boxstream_detector** out) {
  return guarded([&] {
    boxstream_detector*& place = need(out, "no place for the detector");
    place = new boxstream_detector(executor, method, cutoff);
  });
}

void boxstream_detector_destroy(boxstream_detector* detector) {
  delete detector;
}

boxstream_status boxstream_detector_shrink_to_fit(boxstream_detector* detector) {
  return guarded([&] {
    need(detector, "no detector");
    detector->detector.shrink_to_fit();
    std::vector<boxstream::Pair>().swap(detector->pairs);
  });
}

boxstream_status boxstream_find_pairs(boxstream_detector* detector, const boxstream_boxes* a, const boxstream_boxes* b,
                                      const boxstream_pair** pairs, size_t* count, boxstream_stats* stats) {
  return guarded([&] {
    boxstream_detector& d = need(detector, "no detector");
    need(pairs, "no place for pairs"), need(count, "no place for their number");
    check_size(stats);
    const boxstream::Stats did = search_boxes(need(a, "no boxes"), b, Find{d});
    give_pairs(d, pairs, count);
    give(stats, counts_of(did));
  });
}

boxstream_status boxstream_stream_pairs(boxstream_detector* detector, const boxstream_boxes* a,
                                        const boxstream_boxes* b, boxstream_pair_sink sink, void* user,
                                        boxstream_stats* stats) {
  return guarded([&] {
    boxstream_detector& d = need(detector, "no detector");
    need(sink, "no sink");
    check_size(stats);
    const auto pass_on = [&](boxstream::Span<const boxstream::Pair> pairs) {
      return sink(user, reinterpret_cast<const boxstream_pair*>(pairs.data()), pairs.size());
    };
    give(stats, counts_of(search_boxes(need(a, "no boxes"), b, Stream{d, pass_on})));
  });
}

boxstream_status boxstream_find_near_pairs(boxstream_detector* detector, const boxstream_balls* balls, double distance,
                                           const boxstream_pair** pairs, size_t* count, boxstream_stats* stats) {
  return guarded([&] {
    boxstream_detector& d = need(detector, "no detector");
    need(balls, "no balls"), need(pairs, "no place for pairs"), need(count, "no place for their number");
    check_size(stats);
    check_distance(distance);
    boxstream::Stats did;
    with_scalar(balls->scalar, [&](auto scalar) {
      using S = decltype(scalar);
      const auto all =
          view<const boxstream::BasicBall<S>>(static_cast<const S*>(balls->data), balls->count, "no balls");
      did = find_near_pairs(d.detector, all, distance, d.pairs);
    });
    give_pairs(d, pairs, count);
    give(stats, counts_of(did));
  });
}
