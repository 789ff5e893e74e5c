// SPDX-License-Identifier: MIT
#include "batch/front/classes.hpp"

#include <algorithm>
#include <bit>

#include "base/thresholds.hpp"
#include "batch/cuts/cull.hpp"
#include "batch/records/source.hpp"

namespace boxstream::detail {

namespace {

unsigned most_classes(std::size_t boxes, unsigned most) {
  return static_cast<unsigned>(std::min<std::size_t>(boxes / thresholds.least_boxes_of_class, most));
}

}  // namespace

Classes::Classes(Span<const Filter> a, std::size_t size_a, Span<const Filter> b, std::size_t size_b, bool self,
                 Arena& arena)
    : self_(self),
      a_{a, size_a, FilterNumbers(0, most_classes(size_a, self ? most : most / 2))},
      b_{b, size_b, FilterNumbers(most / 2, most / 2 + most_classes(size_b, most / 2))} {
  // A sample decides first: where filters are all alike, or unordered, reading all of them would not pay.
  if (!read_some(a_) || (!self && !read_some(b_)) || !estimate_benefit()) return;
  std::fill_n(boxes_, most, 0);
  worth_it_ = read_all(a_, arena) && (self || read_all(b_, arena)) && estimate_benefit();
}

/// Classes that do not accept each other, the largest one first.
Classes::Set Classes::find_standing() const {
  const unsigned count = a_.numbers.last();
  const auto largest = static_cast<unsigned>(std::max_element(boxes_, boxes_ + count) - boxes_);
  Set standing = 0;
  for (unsigned i = 0; i < count; ++i) {
    const unsigned c = (largest + i) % count;
    if ((accepts_[c] & (standing | only(c))) == 0) standing |= only(c);
  }
  return standing;
}

/// Whether most boxes stand, and are enough to be culled.
bool Classes::choose_standing() {
  if (a_.size < thresholds.cull_much_smaller) return false;
  standing_ = find_standing();
  if (boxes_of(active_ & ~standing_) * thresholds.much_smaller > a_.size) standing_ = 0;
  need_filters_ = false;
  const auto all = static_cast<int>(a_.numbers.last());
  for (int c = 0; c < all && standing_ != 0; ++c)
    need_filters_ |= (standing_ >> c & 1) == 0 && std::popcount(accepts_[c]) != all;
  return standing_ != 0;
}

/// False if there are too many classes.
bool Classes::read_some(Side& side) {
  const std::size_t samples = std::min(side.size / 16, thresholds.sample_of_filters);
  const Filter all_alike;
  for (std::size_t i = 0; i < samples; ++i) {
    // Sampled at irregular places, because filters may be periodic.
    const std::size_t at = (std::uint64_t{static_cast<std::uint32_t>(i) * 0x9E3779B9u} * side.size) >> 32;
    const std::uint8_t c = side.numbers(side.filters.empty() ? all_alike : side.filters[at]);
    if (c == FilterNumbers::none) return false;
    boxes_[c] += side.size / samples;
  }
  return samples != 0;
}

bool Classes::read_all(Side& side, Arena& arena) {
  if (side.filters.empty()) {
    boxes_[side.numbers.first()] = side.size;
    return true;
  }
  // Several counters for each class: consecutive boxes mostly share a class, and one counter would be a dependency.
  constexpr std::size_t at_once = 4;
  std::uint32_t counts[at_once][most] = {};
  FilterNumbers numbers = side.numbers;
  auto* const of_box = arena.allocate<std::uint8_t>(side.size);
  for (std::size_t i = 0; i < side.size; ++i) {
    const std::uint8_t c = numbers(side.filters[i]);
    if (c == FilterNumbers::none) return false;
    of_box[i] = c;
    ++counts[i % at_once][c];
  }
  for (unsigned c = numbers.first(); c < numbers.last(); ++c)
    for (const auto& count : counts) boxes_[c] += count[c];
  side.numbers = numbers;
  side.of_box = of_box;
  return true;
}

void Classes::find_acceptance() {
  std::fill_n(accepts_, most, 0);
  const FilterNumbers &in_a = a_.numbers, &in_b = other().numbers;
  for (unsigned i = in_a.first(); i < in_a.last(); ++i)
    for (unsigned j = in_b.first(); j < in_b.last(); ++j) {
      if (!accepts(in_a[i], in_b[j])) continue;
      accepts_[i] |= only(j);
      accepts_[j] |= only(i);
    }
}

void Classes::merge_duplicates(const Side& side) {
  for (unsigned i = side.numbers.first(); i < side.numbers.last(); ++i) {
    unsigned first = side.numbers.first();
    while (accepts_[first] != accepts_[i]) ++first;
    merged_into_[i] = static_cast<std::uint8_t>(first);
    if (first != i)
      boxes_[first] += boxes_[i];
    else if (accepts_[i] != 0)
      active_ |= only(i);
  }
}

/// In units of the cost of moving a box to its cell, which is about that of its comparisons there. Between two sets it
/// is a quarter more, because each is swept past the other. With few boxes less is saved.
bool Classes::estimate_benefit() {
  find_acceptance();
  active_ = 0;
  merge_duplicates(a_);
  if (!self_) merge_duplicates(b_);
  if (self_ && choose_standing()) return true;
  const std::uint64_t boxes = a_.size + (self_ ? 0 : b_.size);
  std::uint64_t price = boxes / (boxes <= thresholds.records_in_cache ? 4 : 2);
  for_each_join([&](unsigned one, bool with_itself, Set others) {
    const std::uint64_t in_one = boxes_[one], in_others = boxes_of(others), pairs = in_one * in_others;
    if (with_itself) price += thresholds.begin_within + in_one + in_one * in_one / a_.size;
    if (others != 0)
      price += thresholds.begin_between + (in_one + in_others) * 5 / 4 + pairs / a_.size + pairs / other().size;
    return true;
  });
  return price < (self_ ? boxes * 2 : boxes * 9 / 4);
}

std::uint64_t Classes::boxes_of(Set classes) const {
  std::uint64_t sum = 0;
  for (; classes != 0; classes &= classes - 1) sum += boxes_[std::countr_zero(classes)];
  return sum;
}

template <class Visit>
bool Classes::for_each_join(const Visit& visit) const {
  for (Set left = active_; left != 0;) {
    // The class that accepts the most others comes first: then these need not be joined with each of its like.
    unsigned one = 0;
    int most_others = -1;
    for (Set rest = left; rest != 0; rest &= rest - 1) {
      const auto c = static_cast<unsigned>(std::countr_zero(rest));
      const int others = std::popcount(accepts_[c] & left & ~only(c));
      if (others > most_others) {
        one = c;
        most_others = others;
      }
    }
    left &= ~only(one);
    if (!visit(one, (accepts_[one] & only(one)) != 0, accepts_[one] & left)) return false;
  }
  return true;
}

Span<const Record> Classes::Parts::merged(Set classes, Arena& arena) const {
  if (std::has_single_bit(classes)) return of[std::countr_zero(classes)];
  std::size_t size = 0;
  for (Set rest = classes; rest != 0; rest &= rest - 1) size += of[std::countr_zero(rest)].size();
  auto* const records = arena.allocate<Record>(size);
  for (Record* end = records; classes != 0; classes &= classes - 1) {
    const Span<const Record> part = of[std::countr_zero(classes)];
    end = std::copy_n(part.data(), part.size(), end);
  }
  return {records, size};
}

template <class Source>
void Classes::gather(const Source& boxes, const Side& side, Parts& parts, Arena& arena, Stats& stats) const {
  // All records are written, but only those that take part are kept.
  Record* end[most];
  std::uint64_t keep[most];
  const unsigned first = side.numbers.first(), last = side.numbers.last();
  for (unsigned c = first; c < last; ++c) {
    keep[c] = (active_ & only(c)) != 0 ? 1 : 0;
    end[c] = merged_into_[c] == c ? arena.allocate<Record>(keep[c] != 0 ? boxes_[c] : 1) : nullptr;
    parts.of[c] = {end[c], 0};
  }
  Record buffer[load_block];
  for (std::size_t begin = 0; begin < boxes.size(); begin += load_block) {
    const std::size_t count = std::min(load_block, boxes.size() - begin);
    const Loaded loaded = boxes.load(begin, count, buffer);
    stats.invalid += count - static_cast<std::size_t>(std::popcount(loaded.valid));
    for (std::size_t i = 0; i < count; ++i) {
      const unsigned c = merged_into_[side.of_box == nullptr ? first : side.of_box[begin + i]];
      *end[c] = loaded.records[i];
      end[c] += keep[c] & loaded.valid >> i;
    }
  }
  for (unsigned c = first; c < last; ++c)
    parts.of[c] = {parts.of[c].data(), static_cast<std::size_t>(end[c] - parts.of[c].data())};
}

template <class S>
std::optional<bool> Classes::join_with_standing(const BoxSource<S>& boxes, WideTree& tree, CrossSearch& search) const {
  const Arena::Frame frame(search.arena);
  const auto stands = [&](std::size_t i) { return static_cast<std::uint32_t>(standing_ >> a_.of_box[i] & 1); };
  auto* const places = search.arena.allocate<std::uint32_t>(a_.size);
  std::size_t moving = 0;
  for (std::uint32_t i = 0; i < a_.size; ++i) {
    places[moving] = i;
    moving += 1 - stands(i);
  }
  auto* const moved = search.arena.allocate<BasicAabb<S>>(moving);
  for (std::size_t i = 0; i < moving; ++i) moved[i] = boxes.boxes()[places[i]];
  const Culled culled = cull(boxes.with({moved, moving}), boxes, search.kinds, search.arena);
  if (!culled.worthwhile) return std::nullopt;
  search.stats.invalid += culled.invalid_b;
  // Those that move may meet themselves, so all of them are in `b`.
  for (Record& r : culled.b) r.before = stands(r.id) << Record::standing_bit;
  return tree.join_self(RecordSource(culled.b), {});
}

template <class S>
bool Classes::join(const BoxSource<S>& a, const BoxSource<S>& b, WideTree& tree, CrossSearch& two_sets) const {
  Arena& arena = two_sets.arena;
  const Arena::Frame frame(arena);
  if (standing_ != 0) {
    if (const std::optional<bool> done = join_with_standing(a, tree, two_sets)) return *done;
  }
  Parts parts;
  gather(a, a_, parts, arena, two_sets.stats);
  if (!self_) gather(b, b_, parts, arena, two_sets.stats);
  return for_each_join([&](unsigned one, bool with_itself, Set others) {
    const RecordSource part(parts.of[one]);
    if (with_itself && !tree.join_self(part, {})) return false;
    if (others == 0) return true;
    const Arena::Frame merged_frame(arena);
    const RecordSource rest(parts.merged(others, arena));
    return one < a_.numbers.last() ? tree.join_cross(part, rest, {}) : tree.join_cross(rest, part, {});
  });
}

template bool Classes::join(const BoxSource<float>&, const BoxSource<float>&, WideTree&, CrossSearch&) const;
template bool Classes::join(const BoxSource<double>&, const BoxSource<double>&, WideTree&, CrossSearch&) const;

}  // namespace boxstream::detail
