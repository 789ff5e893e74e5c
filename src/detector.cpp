// SPDX-License-Identifier: MIT
#include <boxstream/detector.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace boxstream {

struct Detector::Impl {};
Detector::Detector(DetectorOptions) : impl_(std::make_unique<Impl>()) {}
Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

namespace {
template <class S>
Stats stream(Span<const BasicAabb<S>> a, Span<const BasicAabb<S>> b, bool self, PairSink sink, Span<const Filter> fa,
             Span<const Filter> fb) {
  Stats stats;
  stats.boxes = a.size() + (self ? 0 : b.size());
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < b.size(); ++i)
    if (is_valid(b[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](auto x, auto y) { return b[x].min[0] < b[y].min[0]; });
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    if (!is_valid(a[i])) { ++stats.invalid; continue; }
    for (auto j : order) {
      if (b[j].min[0] > a[i].max[0]) break;
      if (self && j <= i) continue;
      if (!overlaps(a[i], b[j])) continue;
      if (fa.size() && !accepts(fa[i], (self ? fa : fb)[j])) continue;
      Pair p{i, j};
      ++stats.pairs;
      if (!sink(Span<const Pair>(&p, 1))) return stats;
    }
  }
  return stats;
}
}  // namespace
#define PROVISIONAL(Box)                                                                                          \
  Stats Detector::stream_pairs(Span<const Box> a, PairSink sink, Span<const Filter> f) {                           \
    return stream(a, a, true, sink, f, {});                                                                        \
  }                                                                                                                \
  Stats Detector::stream_pairs(Span<const Box> a, Span<const Box> b, PairSink sink, Span<const Filter> fa,         \
                               Span<const Filter> fb) {                                                            \
    return stream(a, b, false, sink, fa, fb);                                                                      \
  }                                                                                                                \
  Stats Detector::find_pairs(Span<const Box> a, std::vector<Pair>& out, Span<const Filter> f) {                    \
    out.clear();                                                                                                   \
    return stream_pairs(a, [&](Span<const Pair> p) { out.insert(out.end(), p.begin(), p.end()); return true; }, f); \
  }                                                                                                                \
  Stats Detector::find_pairs(Span<const Box> a, Span<const Box> b, std::vector<Pair>& out, Span<const Filter> fa,  \
                             Span<const Filter> fb) {                                                              \
    out.clear();                                                                                                   \
    return stream_pairs(a, b, [&](Span<const Pair> p) { out.insert(out.end(), p.begin(), p.end()); return true; }, \
                        fa, fb);                                                                                   \
  }                                                                                                                \
  std::vector<Pair> find_pairs(Span<const Box> a) { std::vector<Pair> o; Detector().find_pairs(a, o); return o; }   \
  std::vector<Pair> find_pairs(Span<const Box> a, Span<const Box> b) {                                             \
    std::vector<Pair> o; Detector().find_pairs(a, b, o); return o;                                                 \
  }
PROVISIONAL(Aabb)
PROVISIONAL(Aabb64)
std::size_t Detector::scratch_bytes() const { return 0; }
const char* simd_target() { return "none"; }
}  // namespace boxstream
