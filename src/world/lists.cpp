// SPDX-License-Identifier: MIT
#include "world/lists.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "world/lists_simd.hpp"
#include "world/reserve.hpp"

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
  if (first_of(key) >= ranks()) return false;
  const std::size_t at = place(key);
  return at < starts_[first_of(key) + 1] && pairs_.second[at] == second_of(key);
}

/// Where the second of this key is, or would be.
std::size_t PairLists::place(PairKey key) const {
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

/// All seconds are looked at: at a cycle each, this is faster than to keep lists from the other end up to date.
void PairLists::expect_of(Span<const std::uint32_t> listed) {
  reserve_more(is_listed_, ranks());
  is_listed_.resize(ranks());
  expect_none();  // may throw, and comes before the marks, which would stay
  for (const std::uint32_t rank : listed) is_listed_[rank] = 1;
  const std::uint8_t* const is_listed = is_listed_.data();
  for (std::size_t w = 0; w < words(); ++w) {
    const std::uint32_t* const second = pairs_.second.data() + 64 * w;
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < 64; ++i) bits |= std::uint64_t{is_listed[second[i]]} << i;
    expected_[w] = bits;
  }
  if (size_ % 64 != 0) expected_[size_ / 64] &= (std::uint64_t{1} << size_ % 64) - 1;
  for (const std::uint32_t rank : listed) {
    is_listed_[rank] = 0;
    for (std::size_t i = starts_[rank]; i < starts_[rank + 1]; ++i) expected_[i / 64] |= std::uint64_t{1} << i % 64;
  }
}

void PairLists::confirm(Span<const Pair> found, std::vector<Pair>& fresh) {
  constexpr std::size_t batch = 1024;
  Pair not_held[batch];
  for (std::size_t first = 0; first < found.size(); first += batch) {
    const Span<const Pair> some = found.subspan(first, std::min(batch, found.size() - first));
    const std::size_t count = confirm_pairs(some, starts_.data(), pairs_.second.data(), expected_.data(), not_held);
    fresh.insert(fresh.end(), not_held, not_held + count);
  }
}

void PairLists::expect(PairKey key) {
  const std::size_t at = place(key);
  expected_[at / 64] |= std::uint64_t{1} << at % 64;
}

/// As if all others had been found.
void PairLists::expect_only(Span<const Pair> pairs) {
  expect_all();
  not_there_.clear();
  confirm(pairs, not_there_);
  for (std::size_t w = 0; w < words(); ++w) expected_[w] = ~expected_[w];
  if (size_ % 64 != 0) expected_[size_ / 64] &= (std::uint64_t{1} << size_ % 64) - 1;
}

void PairLists::exchange(Span<const PairKey> gone, Span<const PairKey> added) {
  if (gone.empty() && added.empty()) return;
  const std::uint64_t next_size = size_ - gone.size() + added.size();
  if (next_size > most) throw std::length_error("boxstream: more than 2^32 - 64 pairs held");
  next_.make_room(static_cast<std::size_t>(next_size));
  if (size_ - gone.size() < added.size() / 8)
    merge_kept(added);
  else
    exchange_pairs(pairs_, size_, starts_.data(), expected_.data(), added, next_);
  std::swap(pairs_, next_);
  size_ = static_cast<std::size_t>(next_size);
  std::fill_n(pairs_.second.data() + size_, PairColumns::slack, 0);
  // A branch or two are mispredicted for each pair that comes or goes, which by then costs more than to start again.
  if (gone.size() + added.size() < ranks() / 16)
    shift_starts(gone, added);
  else
    find_starts();
}

/// For when few stay: what is added is written one after the other, and the places of the others are not looked up.
void PairLists::merge_kept(Span<const PairKey> added) noexcept {
  std::uint32_t* first = next_.first.data();
  std::uint32_t* second = next_.second.data();
  const PairKey* next = added.begin();
  const auto write = [&](PairKey key) {
    *first++ = first_of(key);
    *second++ = second_of(key);
  };
  for (std::size_t w = 0; w < words(); ++w) {
    const std::size_t in_word = std::min<std::size_t>(64, size_ - 64 * w);
    for (std::uint64_t left = ~expected_[w] & (~std::uint64_t{0} >> (64 - in_word)); left != 0; left &= left - 1) {
      const PairKey kept = key_at(64 * w + static_cast<unsigned>(std::countr_zero(left)));
      for (; next != added.end() && *next < kept; ++next) write(*next);
      write(kept);
    }
  }
  for (; next != added.end(); ++next) write(*next);
}

void PairLists::shift_starts(Span<const PairKey> gone, Span<const PairKey> added) noexcept {
  std::uint32_t shift = 0;  // modulo 2^32
  std::size_t rank = 0;
  const auto shift_until = [&](std::size_t end) {
    for (; rank < end; ++rank) starts_[rank] += shift;
  };
  const PairKey* less = gone.begin();
  const PairKey* more = added.begin();
  while (less != gone.end() || more != added.end()) {
    const bool goes = more == added.end() || (less != gone.end() && *less < *more);
    shift_until(std::size_t{first_of(goes ? *less++ : *more++)} + 1);
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
  for (std::size_t i = 0; i < size_; ++i) pairs_.first[i] = new_rank[pairs_.first[i]];
  for (std::size_t i = 0; i < size_; ++i) pairs_.second[i] = new_rank[pairs_.second[i]];
}

void PairLists::clear() noexcept {
  size_ = 0;
  starts_.clear();
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
