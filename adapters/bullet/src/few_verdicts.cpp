// SPDX-License-Identifier: MIT
#include "few_verdicts.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <type_traits>

#include <boxstream/detail/float_environment.hpp>

#include "pending_changes.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

namespace {

using LaneBits = std::conditional_t<sizeof(btScalar) == 4, std::uint32_t, std::uint64_t>;

/// A bit for each lane. A plain array, for compilers make vectors of no other.
constexpr struct BitOfLane {
  constexpr BitOfLane() {
    for (std::size_t i = 0; i < FewVerdicts::most; ++i) bits[i] = LaneBits{1} << i;
  }
  LaneBits bits[FewVerdicts::most] = {};
} of_lane;

}  // namespace

bool FewVerdicts::KeyBox::is_valid() const {
  constexpr auto infinity = std::bit_cast<Key>(std::numeric_limits<btScalar>::infinity());
  for (int d = 0; d < 3; ++d)
    if (lo[d] > hi[d] || lo[d] < ~infinity || hi[d] > infinity) return false;
  return true;
}

/// In a form of which compilers make vectors.
std::uint32_t FewVerdicts::Columns::touching(const KeyBox& box, std::uint32_t size) const {
  const Key min_x = box.lo[0], min_y = box.lo[1], min_z = box.lo[2];
  const Key max_x = box.hi[0], max_y = box.hi[1], max_z = box.hi[2];
  constexpr std::uint32_t vector = 4;  // fewer go one by one: to load a vector of numbers just stored takes longer
  const std::uint32_t lanes = size < vector ? size : (size + 7) / 8 * 8;
  LaneBits touching = 0;
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const bool apart = (lo[0][i] > max_x) | (min_x > hi[0][i]) | (lo[1][i] > max_y) | (min_y > hi[1][i]) |
                       (lo[2][i] > max_z) | (min_z > hi[2][i]);
    touching |= apart ? 0 : of_lane.bits[i];
  }
  return std::uint32_t(touching);
}

void FewVerdicts::note_alone(const Proxy& proxy) {
  if (!are_known_) return;
  for (std::uint32_t others = held_[proxy.position]; others != 0; others &= others - 1)
    held_[std::countr_zero(others)] ^= bit(proxy.position);
  held_[proxy.position] = 0;
  moved_ |= bit(proxy.position);
}

void FewVerdicts::note_destroyed(const Proxy& proxy, std::size_t size) {
  if (!are_known_) return;
  note_alone(proxy);
  const std::uint32_t gone = proxy.position, last = std::uint32_t(size - 1);
  const std::uint32_t last_moved = (moved_ & bit(last)) != 0 ? bit(gone) : 0;
  moved_ &= ~(bit(gone) | bit(last));
  if (gone == last) return;
  boxes_.move(last, gone);
  moved_ |= last_moved;
  held_[gone] = held_[last];
  for (std::uint32_t others = held_[last]; others != 0; others &= others - 1)
    held_[std::countr_zero(others)] ^= bit(gone) | bit(last);
}

void FewVerdicts::learn(const Proxies& live, PairStore& pairs) {
  if (live.size() > most) return note_many();
  are_known_ = searches_left_ == 0;
  if (!are_known_) {
    --searches_left_;
    return;
  }
  moved_ = 0;
  std::fill_n(held_, live.size(), 0u);
  for (const Proxy* proxy : live) boxes_.set(proxy->position, box_in_world(*proxy));
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const std::uint32_t a = position_of(pairs[i].m_pProxy0), b = position_of(pairs[i].m_pProxy1);
    held_[a] |= bit(b);
    held_[b] |= bit(a);
  }
}

FewVerdicts::Answer FewVerdicts::compare(const Proxies& live, bool by_masks) {
  if (moved_ == 0) return Answer::nothing;
  const auto size = std::uint32_t(live.size());
  const std::uint32_t all = size == 0 ? 0 : ~std::uint32_t{0} >> (most - size);
  Answer answer = Answer::nothing;
  for (std::uint32_t left = moved_; left != 0; left &= left - 1) {
    const auto mover = std::uint32_t(std::countr_zero(left));
    const KeyBox box = boxes_.get(mover);
    if (!box.is_valid()) return Answer::unknown;
    std::uint32_t changed = (boxes_.touching(box, size) & all & ~bit(mover)) ^ held_[mover];
    for (; changed != 0; changed &= changed - 1) {
      const auto other = std::uint32_t(std::countr_zero(changed));
      if (!are_held(mover, other)) {
        const Proxy &a = *live[mover], &b = *live[other];
        if (!by_masks || a.has_new_filter() || b.has_new_filter()) return Answer::unknown;
        if (!accepts(a.world_filter, b.world_filter)) continue;
      }
      if (answer == Answer::nothing) std::fill_n(changed_, size, 0u);
      answer = Answer::pairs;
      changed_[mover] |= bit(other);
      changed_[other] |= bit(mover);
    }
  }
  return answer;
}

void FewVerdicts::note_changes(const Proxies& live, std::vector<btBroadphasePair>& begun) {
  begun.clear();
  has_any_ended_ = false;
  for (std::uint32_t a = 0; a < live.size(); ++a) {
    for (std::uint32_t others = changed_[a] & ~held_[a] & ~(bit(a) - 1); others != 0; others &= others - 1)
      begun.emplace_back(*live[a], *live[std::size_t(std::countr_zero(others))]);
    has_any_ended_ |= (changed_[a] & held_[a]) != 0;
    held_[a] ^= changed_[a];
  }
}

void FewVerdicts::validate(const Proxies& live, PairStore& pairs, bool by_masks) const {
  const auto check = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  if (!are_known_) return;
  check(live.size() <= most, "verdicts: of many proxies");
  const boxstream::detail::DefaultFloatEnvironment environment;
  std::size_t bits = 0;
  for (const Proxy* a : live)
    for (const Proxy* b : live) {
      if (a == b) continue;
      const bool has_moved = (moved_ & (bit(a->position) | bit(b->position))) != 0;
      const bool touch =
          is_valid(box_in_world(*a)) && is_valid(box_in_world(*b)) && overlaps(box_in_world(*a), box_in_world(*b));
      if (!are_held(a->position, b->position)) {
        const bool are_filters_known = by_masks && !a->has_new_filter() && !b->has_new_filter();
        check(has_moved || !touch || !are_filters_known || !accepts(a->world_filter, b->world_filter),
              "verdicts: a pair that touches and is not held");
        continue;
      }
      ++bits;
      check(pairs.find(*a, *b) != PairStore::npos, "verdicts: a pair that is not held");
      check(has_moved || touch, "verdicts: a pair that does not touch");
    }
  check(bits == 2 * std::size_t{pairs.size()}, "verdicts: other pairs are held");
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
