// SPDX-License-Identifier: MIT
#include "few_verdicts.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <boxstream/detail/float_environment.hpp>

#include "pending_changes.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

/// With branches: verdicts are mostly those of the batch before, so that they are easy to predict.
bool touches(const PendingChanges::Box& box, const Proxy& other) {
  if (other.margin != 0) return overlaps(box, box_in_world(other));
  for (int d = 0; d < 3; ++d)
    if (!(box.min[d] <= other.m_aabbMax.m_floats[d]) || !(other.m_aabbMin.m_floats[d] <= box.max[d])) return false;
  return true;
}

std::uint32_t position_of(const btBroadphaseProxy* proxy) {
  return static_cast<const Proxy*>(proxy)->position;
}

}  // namespace

void FewVerdicts::note_destroyed(const Proxy& proxy, std::size_t size) {
  if (!are_known_) return;
  const std::uint32_t gone = proxy.position, last = std::uint32_t(size - 1);
  if (held_[gone] != 0) return forget();
  const std::uint32_t last_moved = (moved_ & bit(last)) != 0 ? bit(gone) : 0;
  moved_ &= ~(bit(gone) | bit(last));
  if (gone == last) return;
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
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const std::uint32_t a = position_of(pairs[i].m_pProxy0), b = position_of(pairs[i].m_pProxy1);
    held_[a] |= bit(b);
    held_[b] |= bit(a);
  }
}

bool FewVerdicts::touch_as_held(const Proxies& live, bool by_masks) const {
  const boxstream::detail::DefaultFloatEnvironment environment;
  const auto size = std::uint32_t(live.size());
  const bool all_moved = moved_ == bit(size) - 1;  // each pair once is enough then
  for (std::uint32_t left = moved_; left != 0; left &= left - 1) {
    const auto mover = std::uint32_t(std::countr_zero(left));
    const Proxy& proxy = *live[mover];
    const PendingChanges::Box box = box_in_world(proxy);
    if (!is_valid(box)) return false;
    for (std::uint32_t other = all_moved ? mover + 1 : 0; other < size; ++other) {
      const bool held = are_held(mover, other);
      if (touches(box, *live[other]) == held || other == mover) continue;
      if (held || !by_masks || accepts(proxy.world_filter, live[other]->world_filter)) return false;
    }
  }
  return true;
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
      const bool touch = is_valid(box_in_world(*a)) && is_valid(box_in_world(*b)) && touches(box_in_world(*a), *b);
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
