// SPDX-License-Identifier: MIT
#include "world/state/lists.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/reserve.hpp"
#include "base/thresholds.hpp"
#include "world/state/lists_simd.hpp"

namespace boxstream::detail {

namespace {

/// Like assign, but room grows geometrically: numbers of pairs go up and down by little from frame to frame.
void fill(std::vector<std::uint64_t>& words, std::size_t size, std::uint64_t value) {
  words.clear();
  reserve_more(words, size);
  words.assign(size, value);
}

}  // namespace

void PairColumns::make_room(std::size_t pairs) {
  for (auto* column : {&first, &second}) {
    if (column->size() >= pairs + slack) continue;
    column->clear();
    reserve_more(*column, pairs + slack);
    column->resize(column->capacity());
  }
}

bool PairLists::contains(PairKey key) const {
  const std::size_t at = place(key);
  return at < size_ && key_at(at) == key;
}

std::size_t PairLists::place(PairKey key) const {
  if (first_of(key) >= ranks()) return size_;
  const auto* const list = pairs_.second.data();
  return static_cast<std::size_t>(
      std::lower_bound(list + starts_[first_of(key)], list + starts_[first_of(key) + 1], second_of(key)) - list);
}

void PairLists::reserve_ranks(std::size_t ranks) {
  if (starts_.size() > ranks) return;
  reserve_more(starts_, ranks + 1 - starts_.size());
  if (pairs_.second.empty()) pairs_.make_room(0);
  starts_.resize(ranks + 1, static_cast<std::uint32_t>(size_));
}

void PairLists::expect_none() {
  fill(expected_, words() + 1, 0);
}

void PairLists::expect_all() {
  fill(expected_, words() + 1, ~std::uint64_t{0});
  expected_[words()] = 0;
  if (size_ % 64 != 0) expected_[size_ / 64] = (std::uint64_t{1} << size_ % 64) - 1;
}

/// All seconds are looked at, for each of a few ranks by vectors, for more at a cycle each: this is faster than to keep
/// lists from the other end up to date.
void PairLists::expect_of(Span<const std::uint32_t> listed) {
  if (listed.size() <= thresholds.listed_one_by_one) {
    expect_none();
    for (const std::uint32_t rank : listed)
      for_each_with_second(rank, [this](std::size_t i) { expected_[i / 64] |= std::uint64_t{1} << i % 64; });
  } else {
    mark_listed(listed);
  }
  for (const std::uint32_t rank : listed)
    for (std::size_t i = starts_[rank]; i < starts_[rank + 1]; ++i) expected_[i / 64] |= std::uint64_t{1} << i % 64;
}

std::size_t PairLists::next_group_with(std::uint32_t second, std::size_t first) const {
  return group_with(pairs_.second.data(), first, groups_before(second), second);
}

/// The pairs of which the second rank is listed.
void PairLists::mark_listed(Span<const std::uint32_t> listed) {
  reserve_more(is_listed_, ranks());
  is_listed_.resize(ranks());
  expect_none();  // may throw, and comes before the marks, which would stay
  for (const std::uint32_t rank : listed) {
    assert(rank < ranks());
    is_listed_[rank] = 1;
  }
  const std::uint8_t* const is_listed = is_listed_.data();
  for (std::size_t w = 0; w < words(); ++w) {
    const std::uint32_t* const second = pairs_.second.data() + 64 * w;
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < 64; ++i) bits |= std::uint64_t{is_listed[second[i]]} << i;
    expected_[w] = bits;
  }
  if (size_ % 64 != 0) expected_[size_ / 64] &= (std::uint64_t{1} << size_ % 64) - 1;
  for (const std::uint32_t rank : listed) is_listed_[rank] = 0;
}

void PairLists::confirm(Span<const Pair> found, std::vector<std::uint64_t>& expected, std::vector<Pair>& fresh) const {
  constexpr std::size_t batch = 4 * thresholds.portion;
  Pair not_held[batch];
  for (std::size_t first = 0; first < found.size(); first += batch) {
    const Span<const Pair> some = found.subspan(first, std::min(batch, found.size() - first));
    const std::size_t count = confirm_pairs(some, starts_.data(), pairs_.second.data(), expected.data(), not_held);
    fresh.insert(fresh.end(), not_held, not_held + count);
  }
}

/// Each thread has bits of its own, for those of different pairs share words.
void PairLists::confirm(Span<const Pair> found, const UpdateThreads& threads, std::vector<Pair>& fresh) {
  assert(expected_.size() == words() + 1);
  const std::size_t parts = threads.parts(found.size());
  if (parts == 1) return confirm(found, expected_, fresh);
  if (parts_.size() < parts) parts_.resize(parts);
  threads.run(parts, [&](std::size_t i) {
    Part& part = parts_[i];
    const std::size_t first = begin_of_part(found.size(), i, parts);
    part.fresh.clear();
    part.expected.assign(expected_.begin(), expected_.end());
    confirm(found.subspan(first, begin_of_part(found.size(), i + 1, parts) - first), part.expected, part.fresh);
  });
  for (std::size_t i = 0; i < parts; ++i) {
    const Part& part = parts_[i];
    for (std::size_t w = 0; w < expected_.size(); ++w) expected_[w] &= part.expected[w];
    fresh.insert(fresh.end(), part.fresh.begin(), part.fresh.end());
  }
}

void PairLists::find_places(Span<const PairKey> pairs, std::vector<std::uint32_t>& places) const {
  assert(std::all_of(pairs.begin(), pairs.end(), [this](PairKey key) { return first_of(key) < ranks(); }));
  places.clear();
  reserve_more(places, pairs.size());
  places.resize(pairs.size());
  boxstream::detail::find_places(pairs, starts_.data(), pairs_.second.data(), places.data());
}

void PairLists::exchange(Span<const std::uint32_t> gone, Span<const PairKey> added,
                         std::vector<std::uint32_t>& arrived) {
  assert(std::is_sorted(gone.begin(), gone.end()) && (gone.empty() || gone[gone.size() - 1] < size_));
  assert(std::is_sorted(added.begin(), added.end()));
  const std::uint64_t next_size = size_ - gone.size() + added.size();
  if (next_size > most) throw std::length_error("boxstream: more than 2^32 - 64 pairs held");
  find_places(added, arrived);
  if (gone.empty() && added.empty()) return;
  const std::uint32_t* left = gone.begin();
  for (std::size_t i = 0; i < added.size(); ++i) {
    assert(arrived[i] == size_ || key_at(arrived[i]) != added[i]);
    while (left != gone.end() && *left < arrived[i]) ++left;
    arrived[i] += static_cast<std::uint32_t>(i) - static_cast<std::uint32_t>(left - gone.begin());
  }
  const std::size_t events = gone.size() + added.size();
  const bool in_place =
      thresholds.pairs_of_event * events <= size_ && next_size + PairColumns::slack <= pairs_.second.size();
  if (!in_place) next_.make_room(static_cast<std::size_t>(next_size));
  const bool few = events < ranks() / thresholds.ranks_of_event;
  if (few) shift_starts(gone, added);
  const Splice splice{gone, arrived};
  if (in_place)
    move_runs(size_, splice, [this](std::size_t from, std::size_t count, std::size_t to) {
      for (auto* column : {&pairs_.first, &pairs_.second})
        std::memmove(column->data() + to, column->data() + from, count * sizeof(std::uint32_t));
    });
  else
    copy_runs(splice);
  for (std::size_t i = 0; i < added.size(); ++i) {
    pairs_.first[arrived[i]] = first_of(added[i]);
    pairs_.second[arrived[i]] = second_of(added[i]);
  }
  size_ = static_cast<std::size_t>(next_size);
  std::fill_n(pairs_.second.data() + size_, PairColumns::slack, 0);
  if (!few) find_starts();
}

/// What was found, in order in `next_`: counted, then put in place, then sorted list by list, as these are short.
void PairLists::lay_lists(Span<const Pair> found) {
  if (found.size() > most) throw std::length_error("boxstream: more than 2^32 - 64 pairs held");
  next_.make_room(found.size());
  next_starts_.clear();
  reserve_more(next_starts_, ranks() + 2);
  next_starts_.resize(ranks() + 2, 0);
  std::uint32_t* const ends = next_starts_.data() + 1;  // at first where lists begin
  for (const Pair pair : found) ++ends[pair.a + 1];
  for (std::size_t rank = 0; rank < ranks(); ++rank) ends[rank + 1] += ends[rank];
  std::uint32_t* const first = next_.first.data();
  std::uint32_t* const second = next_.second.data();
  for (const Pair pair : found) second[ends[pair.a]++] = pair.b;
  next_starts_.pop_back();
  // Most lists are shorter than a piece, which is written without a branch.
  constexpr std::uint32_t piece = 8;
  static_assert(piece <= PairColumns::slack);
  for (std::uint32_t rank = 0; rank < ranks(); ++rank) {
    const std::uint32_t begin = next_starts_[rank], end = ends[rank];
    std::uint32_t written = begin;
    do {
      std::fill_n(first + written, piece, rank);
      written += piece;
    } while (written < end);
    if (end - begin > 1) std::sort(second + begin, second + end);
  }
}

/// No branch depends on what is found but the last one.
void PairLists::merge(Span<const Pair> found, std::vector<PairKey>& begun, std::vector<std::uint32_t>& begun_places,
                      std::vector<PairKey>& ended, std::vector<std::uint32_t>& ended_places) {
  lay_lists(found);
  begun_places.resize(found.size() + 1);
  ended_places.resize(size_ + 1);
  std::uint32_t held = 0, now = 0;
  std::size_t begun_count = 0, ended_count = 0;
  while (held < size_ && now < found.size()) {
    const PairKey old = key_at(held), key = next_.key_at(now);
    begun_places[begun_count] = now;
    ended_places[ended_count] = held;
    begun_count += key < old;
    ended_count += old < key;
    held += old <= key;
    now += key <= old;
  }
  for (; now < found.size(); ++now) begun_places[begun_count++] = now;
  for (; held < size_; ++held) ended_places[ended_count++] = held;
  begun_places.resize(begun_count);
  ended_places.resize(ended_count);
  begun.resize(begun_count);
  ended.resize(ended_count);
  for (std::size_t i = 0; i < begun_count; ++i) begun[i] = next_.key_at(begun_places[i]);
  for (std::size_t i = 0; i < ended_count; ++i) ended[i] = key_at(ended_places[i]);
}

void PairLists::take_merged() noexcept {
  std::swap(pairs_, next_);
  starts_.swap(next_starts_);
  size_ = starts_.back();
  std::fill_n(pairs_.second.data() + size_, PairColumns::slack, 0);
}

/// Most runs are short: a copy of a fixed length takes no branch, and what it writes too much is written again.
void PairLists::copy_runs(const Splice& splice) noexcept {
  constexpr std::size_t piece = 16;
  static_assert(piece <= PairColumns::slack);
  const auto copy = [](const std::uint32_t* from, std::size_t count, std::uint32_t* to) {
    for (std::size_t i = 0; i < count; i += piece) std::memcpy(to + i, from + i, piece * sizeof(std::uint32_t));
  };
  for_each_run(size_, splice, [&](std::size_t from, std::size_t count, std::size_t to) {
    copy(pairs_.first.data() + from, count, next_.first.data() + to);
    copy(pairs_.second.data() + from, count, next_.second.data() + to);
  });
  std::swap(pairs_, next_);
}

/// Before the pairs themselves change.
void PairLists::shift_starts(Span<const std::uint32_t> gone, Span<const PairKey> added) noexcept {
  std::uint32_t shift = 0;  // modulo 2^32
  std::size_t rank = 0;
  const auto shift_until = [&](std::size_t end) {
    for (; rank < end; ++rank) starts_[rank] += shift;
  };
  const std::uint32_t* less = gone.begin();
  const PairKey* more = added.begin();
  while (less != gone.end() || more != added.end()) {
    const bool goes = more == added.end() || (less != gone.end() && key_at(*less) < *more);
    shift_until(std::size_t{goes ? pairs_.first[*less++] : first_of(*more++)} + 1);
    shift += goes ? ~std::uint32_t{0} : 1;
  }
  shift_until(starts_.size());
}

/// Each pair writes where the list after it may begin, the last of a list in the end; ranks without a pair take it from
/// the rank before.
void PairLists::find_starts() noexcept {
  std::fill(starts_.begin(), starts_.end(), 0);
  const std::uint32_t* const first = pairs_.first.data();
  std::uint32_t* const after = starts_.data() + 1;
  for (std::uint32_t i = 0; i < size_; ++i) after[first[i]] = i + 1;
  std::uint32_t start = 0;
  for (std::uint32_t& s : starts_) s = start = std::max(s, start);
}

void PairLists::remap(Span<const std::uint32_t> new_rank, std::uint32_t dropped) noexcept {
  if (starts_.empty()) return;
  std::size_t kept = 0;
  for (std::size_t rank = 0; rank < ranks(); ++rank)
    if (new_rank[rank] != dropped) starts_[kept++] = starts_[rank];
  starts_[kept] = static_cast<std::uint32_t>(size_);
  starts_.resize(kept + 1);
  for (std::size_t i = 0; i < size_; ++i)
    assert(new_rank[pairs_.first[i]] != dropped && new_rank[pairs_.second[i]] != dropped);
  for (std::size_t i = 0; i < size_; ++i) pairs_.first[i] = new_rank[pairs_.first[i]];
  for (std::size_t i = 0; i < size_; ++i) pairs_.second[i] = new_rank[pairs_.second[i]];
}

void PairLists::clear() noexcept {
  size_ = 0;
  starts_.clear();
}

void PairLists::give_back() noexcept {
  next_ = {};
  std::vector<std::uint32_t>().swap(next_starts_);
  std::vector<Part>().swap(parts_);
  std::vector<std::uint64_t>().swap(expected_);
  if (pairs_.second.size() <= size_ + PairColumns::slack) return;
  for (auto* column : {&pairs_.first, &pairs_.second}) {
    column->resize(size_ + PairColumns::slack);
    column->shrink_to_fit();
  }
}

void PairLists::shrink_to_fit() {
  give_back();
  starts_.shrink_to_fit();
  std::vector<std::uint8_t>().swap(is_listed_);
  if (size_ != 0) return;
  pairs_ = {};  // there is room again before ranks have lists
  std::vector<std::uint32_t>().swap(starts_);
}

void PairLists::validate() const {
  if (starts_.empty() ? size_ != 0 : starts_.front() != 0 || starts_.back() != size_)
    throw std::logic_error("pairs: lists do not span all seconds");
  if (!std::is_sorted(starts_.begin(), starts_.end())) throw std::logic_error("pairs: lists are not in order");
  for (const auto* column : {&pairs_.first, &pairs_.second})
    if (!starts_.empty() && column->size() < size_ + PairColumns::slack)
      throw std::logic_error("pairs: no room behind");
  for (std::size_t rank = 0; rank < ranks(); ++rank)
    for (std::size_t i = starts_[rank]; i < starts_[rank + 1]; ++i)
      if (pairs_.first[i] != rank) throw std::logic_error("pairs: a pair is in the wrong list");
  PairKey last = 0;
  for_each([&](PairKey key) {
    if (first_of(key) >= second_of(key)) throw std::logic_error("a held pair is not (older, younger)");
    if (key <= last) throw std::logic_error("held pairs are not strictly sorted");
    last = key;
    return true;
  });
}

}  // namespace boxstream::detail
