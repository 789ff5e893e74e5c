// SPDX-License-Identifier: MIT
#include "few_verdicts.hpp"

#include <algorithm>
#include <stdexcept>

#include <boxstream/detail/float_environment.hpp>

#include "pending_changes.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

using Box = BasicAabb<btScalar>;

Box box_in_world(const Proxy& proxy) {
  return PendingChanges::grown(box_of(proxy.m_aabbMin, proxy.m_aabbMax), proxy.margin);
}

/// With branches: verdicts are mostly those of the batch before, so that they are easy to predict.
bool touches(const Box& box, const Proxy& other) {
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
  const std::uint64_t last_moved = moved_ >> last & 1;
  moved_ &= ~(bit(gone) | bit(last));
  if (gone == last) return;
  moved_ |= last_moved << gone;
  held_[gone] = held_[last];
  for (std::uint64_t others = held_[last]; others != 0; others &= others - 1)
    held_[std::countr_zero(others)] ^= bit(gone) | bit(last);
}

void FewVerdicts::learn(const Proxies& live, PairStore& pairs) {
  if (live.size() > most) return note_many();
  are_known_ = searches_left_ == 0;
  if (!are_known_) {
    --searches_left_;
    return;
  }
  if (held_batches_ >= patience_) patience_ = std::min(2 * patience_, most_patience);
  held_batches_ = 0;
  moved_ = 0;
  std::fill_n(held_, live.size(), 0);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const std::uint32_t a = position_of(pairs[i].m_pProxy0), b = position_of(pairs[i].m_pProxy1);
    held_[a] |= bit(b);
    held_[b] |= bit(a);
  }
}

bool FewVerdicts::hold(const Proxies& live) {
  constexpr std::size_t most_looks = 128;  // more are left to vectors
  if (!are_known_ || held_batches_ >= patience_) return false;
  if (std::size_t(std::popcount(moved_)) * live.size() > most_looks) return false;
  const boxstream::detail::DefaultFloatEnvironment environment;
  const auto size = std::uint32_t(live.size());
  const bool all_moved = std::size_t(std::popcount(moved_)) == live.size();  // each pair once is enough then
  for (std::uint64_t left = moved_; left != 0; left &= left - 1) {
    const auto mover = std::uint32_t(std::countr_zero(left));
    const Box box = box_in_world(*live[mover]);
    if (!is_valid(box)) return false;
    for (std::uint32_t other = all_moved ? mover + 1 : 0; other < size; ++other)
      if (touches(box, *live[other]) != are_held(mover, other) && other != mover) return false;
  }
  moved_ = 0;
  ++held_batches_;
  return true;
}

void FewVerdicts::validate(const Proxies& live, PairStore& pairs) const {
  const auto check = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  if (!are_known_) return;
  check(live.size() <= most, "verdicts: of many proxies");
  const boxstream::detail::DefaultFloatEnvironment environment;
  for (const Proxy* a : live)
    for (const Proxy* b : live) {
      if (!are_held(a->position, b->position)) continue;
      check(are_held(b->position, a->position), "verdicts: one without the other");
      check(pairs.find(*a, *b) != PairStore::npos, "verdicts: a pair that is not held");
      const bool moved = (moved_ & (bit(a->position) | bit(b->position))) != 0;
      check(moved || touches(box_in_world(*a), *b), "verdicts: a pair that does not touch");
    }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
