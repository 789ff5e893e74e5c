// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "broadphase_impl.hpp"
#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
Broadphase::Impl::RoomsAnswer Broadphase::Impl::ask_rooms() {
  has_new_filters = has_new_filters || (may_refuse && has_written_filter_in_quiet());
  const bool are_sound = own->user_changes().empty() && pending.empty() && is_rule_known() && !has_new_filters;
  if (!are_sound || !or_fatal([&] { return rooms.settle(live, rooms_choice, price_of_search()); })) {
    close_rooms();
    return RoomsAnswer::unknown;
  }
  ++held_batches;
  if (!rooms.begun().empty() || !rooms.ended().empty() || !own->is_settled()) return RoomsAnswer::pairs;
  stats.moved = stats.begun = stats.ended = 0;
  stats.search = {};
  return RoomsAnswer::nothing;
}

/// To pending changes.
void Broadphase::Impl::pass_on_differing() {
  if (!rooms.are_open()) return;
  for (Proxy* proxy : with_rooms()) {
    if (!rooms.differs(*proxy)) continue;
    const Box box = box_in_world(*proxy);
    pending.move(*proxy, box);
    few_verdicts.note_move(*proxy, box);
    if (surroundings.are_kept()) surroundings.note_move(*proxy, box);
    rooms.note_passed_on(*proxy);
  }
}

void Broadphase::Impl::close_rooms() {
  if (!rooms.are_open()) return;
  pass_on_differing();
  all_have_begun = false;
  const bool were_few = rooms.are_few();
  rooms.close(live);
  has_pending.store(true, std::memory_order_relaxed);
  is_quiet = false;
  if (were_few) {
    constexpr unsigned least = 4, most_few_failures = 10;
    few_failures = held_batches < least ? std::min(few_failures + 1, most_few_failures) : 0;
    few_wait = few_failures == 0 ? 0 : 1u << few_failures;
    return;
  }
  rooms_choice.closed();
}

void Broadphase::Impl::follow_rooms() {
  if (rooms.are_open()) {
    const bool as_expected = stats.begun == rooms.begun().size() && stats.ended == rooms.ended().size();
    if (!as_expected || !pending.empty() || !own->holds_worlds_pairs()) close_rooms();
    return;
  }
  if (options.method == Method::hybrid) return;  // the method of the paper searches in each step
  if (const Span<const ProxyId> moved = pending.last_moved();
      moved.size() == stats.moved && 8 * stats.moved < stats.proxies) {
    rooms_choice.opens(live.size(), false);
    if (moved.empty() || has_pending.load(std::memory_order_relaxed) || !own->holds_worlds_pairs()) return;
    if (few_wait > 0) {
      --few_wait;
      return;
    }
    held_batches = 0;
    or_fatal([&] { rooms.open_few(world, moved); });
    return;
  }
  const bool can_open = all_have_begun && own->holds_worlds_pairs();
  if (!rooms_choice.opens(live.size(), is_calm() && can_open)) return;
  flush_alone();  // see can_only_end
  held_batches = 0;
  or_fatal([&] {
    rooms.filters().clear();
    for (const Proxy* proxy : live) rooms.filters().push_back(filter_for_world(*proxy));
    rooms_choice.opened(live.size());
    if (!rooms.open(live, own->store())) rooms_choice.closed();
  });
}

/// Many boxes move, each by little, and few pairs begin or end.
bool Broadphase::Impl::is_calm() {
  const bool may_be = 8 * stats.moved >= stats.proxies && stats.moved > 0 && stats.invalid == 0 &&
                      stats.begun + stats.ended <= 2 + stats.moved / 8;
  if (!may_be) {
    sampled.clear();
    return false;
  }
  constexpr std::size_t most_sampled = 32;
  const std::size_t step = live.size() / most_sampled + 1;
  const boxstream::detail::DefaultFloatEnvironment environment;
  std::size_t far = 0, count = 0;
  const bool has_last = sampled.size() == (live.size() + step - 1) / step;
  sampled.resize((live.size() + step - 1) / step);
  for (std::size_t i = 0; i < live.size(); i += step, ++count) {
    const Box box = box_in_world(*live[i]), last = std::exchange(sampled[count], box);
    bool is_far = false;
    for (int d = 0; d < 3; ++d) {
      const btScalar most = (box.max[d] - box.min[d]) / 64;
      is_far |= !(std::abs(box.min[d] - last.min[d]) <= most) || !(std::abs(box.max[d] - last.max[d]) <= most);
    }
    far += is_far;
  }
  return has_last && 8 * far <= count;
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
