// SPDX-License-Identifier: MIT
#include <boxstream/detector.hpp>

#include <stdexcept>

#include "arena.hpp"
#include "pair_buffer.hpp"
#include "tree.hpp"

namespace boxstream {

namespace {

using detail::PairBuffer;

/// The boxes and filters of one call. For a single set, `b` is the same as `a`.
template <class S>
struct Input {
  Span<const BasicAabb<S>> a, b;
  Span<const Filter> filters_a, filters_b;
};

template <class S>
void check(Span<const BasicAabb<S>> boxes, Span<const Filter> filters) {
  if (boxes.size() >= UINT32_MAX) throw std::length_error("boxstream: more than 2^32 - 2 boxes in a set");
  if (!filters.empty() && filters.size() != boxes.size())
    throw std::invalid_argument("boxstream: there must be no filters, or one for each box");
}

/// Drops pairs that only seemed to overlap or that the filters refuse, and passes the rest on.
template <class S>
class DeliveringBuffer final : public PairBuffer {
 public:
  DeliveringBuffer(const Input<S>& input, PairSink sink, Stats& stats) : input_(input), sink_(sink), stats_(stats) {}

 protected:
  bool take(Pair* pairs, std::size_t count) override {
    if constexpr (sizeof(S) == 8)
      count = keep(pairs, count, [&](Pair p) { return detail::overlap_exactly(input_.a[p.a], input_.b[p.b]); });
    if (!input_.filters_a.empty() || !input_.filters_b.empty())
      count = keep(pairs, count, [&](Pair p) {
        return accepts(input_.filters_a.empty() ? Filter{} : input_.filters_a[p.a],
                       input_.filters_b.empty() ? Filter{} : input_.filters_b[p.b]);
      });
    if (count == 0) return true;
    stats_.pairs += count;
    return sink_(Span<const Pair>(pairs, count));
  }

 private:
  template <class Predicate>
  static std::size_t keep(Pair* pairs, std::size_t count, Predicate predicate) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Pair p = pairs[i];
      pairs[kept] = p;
      kept += predicate(p) ? 1 : 0;
    }
    return kept;
  }

  Input<S> input_;
  PairSink sink_;
  Stats& stats_;
};

template <class S>
std::uint64_t count_invalid(Span<const BasicAabb<S>> boxes) {
  std::uint64_t invalid = 0;
  for (const BasicAabb<S>& box : boxes) invalid += detail::has_valid_keys(box) ? 0 : 1;
  return invalid;
}

}  // namespace

struct Detector::Impl {
  DetectorOptions options;
  detail::Arena arena;

  template <class S>
  Stats stream(const Input<S>& input, bool self, PairSink sink) {
    check(input.a, input.filters_a);
    check(input.b, input.filters_b);
    Stats stats;
    stats.boxes = input.a.size() + (self ? 0 : input.b.size());
    stats.invalid = count_invalid(input.a) + (self ? 0 : count_invalid(input.b));
    {
      detail::Arena::Frame frame(arena);
      DeliveringBuffer<S> buffer(input, sink, stats);
      const auto kind = sizeof(S) == 4 ? detail::KeyKind::float32 : detail::KeyKind::float64;
      const auto order = self ? detail::PairOrder::smaller_first : detail::PairOrder::first_set_first;
      detail::Tree tree(arena, buffer, kind, order, stats);
      const detail::BoxSource<S> a(input.a), b(input.b);
      if (self ? tree.join_self(a, {}) : tree.join_cross(a, b, {})) buffer.flush();
    }
    arena.settle();
    return stats;
  }

  template <class S>
  Stats find(const Input<S>& input, bool self, std::vector<Pair>& out) {
    out.clear();
    try {
      return stream(input, self, [&out](Span<const Pair> pairs) {
        out.insert(out.end(), pairs.begin(), pairs.end());
        return true;
      });
    } catch (...) {
      out.clear();
      throw;
    }
  }
};

Detector::Detector(DetectorOptions options) : impl_(std::make_unique<Impl>()) { impl_->options = options; }
Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

Stats Detector::find_pairs(Span<const Aabb> boxes, std::vector<Pair>& out, Span<const Filter> filters) {
  return impl_->find<float>({boxes, boxes, filters, filters}, true, out);
}

Stats Detector::find_pairs(Span<const Aabb64> boxes, std::vector<Pair>& out, Span<const Filter> filters) {
  return impl_->find<double>({boxes, boxes, filters, filters}, true, out);
}

Stats Detector::find_pairs(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& out, Span<const Filter> filters_a,
                           Span<const Filter> filters_b) {
  return impl_->find<float>({a, b, filters_a, filters_b}, false, out);
}

Stats Detector::find_pairs(Span<const Aabb64> a, Span<const Aabb64> b, std::vector<Pair>& out,
                           Span<const Filter> filters_a, Span<const Filter> filters_b) {
  return impl_->find<double>({a, b, filters_a, filters_b}, false, out);
}

Stats Detector::stream_pairs(Span<const Aabb> boxes, PairSink sink, Span<const Filter> filters) {
  return impl_->stream<float>({boxes, boxes, filters, filters}, true, sink);
}

Stats Detector::stream_pairs(Span<const Aabb64> boxes, PairSink sink, Span<const Filter> filters) {
  return impl_->stream<double>({boxes, boxes, filters, filters}, true, sink);
}

Stats Detector::stream_pairs(Span<const Aabb> a, Span<const Aabb> b, PairSink sink, Span<const Filter> filters_a,
                             Span<const Filter> filters_b) {
  return impl_->stream<float>({a, b, filters_a, filters_b}, false, sink);
}

Stats Detector::stream_pairs(Span<const Aabb64> a, Span<const Aabb64> b, PairSink sink, Span<const Filter> filters_a,
                             Span<const Filter> filters_b) {
  return impl_->stream<double>({a, b, filters_a, filters_b}, false, sink);
}

std::size_t Detector::scratch_bytes() const { return impl_->arena.capacity(); }

namespace {

template <class S>
std::vector<Pair> find_once(Span<const BasicAabb<S>> a) {
  std::vector<Pair> pairs;
  Detector().find_pairs(a, pairs);
  return pairs;
}

template <class S>
std::vector<Pair> find_once(Span<const BasicAabb<S>> a, Span<const BasicAabb<S>> b) {
  std::vector<Pair> pairs;
  Detector().find_pairs(a, b, pairs);
  return pairs;
}

}  // namespace

std::vector<Pair> find_pairs(Span<const Aabb> boxes) { return find_once(boxes); }
std::vector<Pair> find_pairs(Span<const Aabb64> boxes) { return find_once(boxes); }
std::vector<Pair> find_pairs(Span<const Aabb> a, Span<const Aabb> b) { return find_once(a, b); }
std::vector<Pair> find_pairs(Span<const Aabb64> a, Span<const Aabb64> b) { return find_once(a, b); }

}  // namespace boxstream
