// SPDX-License-Identifier: MIT
#include "few_verdicts.hpp"

#include <new>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include <boxstream/detail/float_environment.hpp>

#include "pending_changes.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

void FewVerdicts::note_alone(const Proxy& proxy) {
  if (!are_known_) return;
  with_table([&](auto& table) {
    table.release(proxy.position);
    table.moved.put(proxy.position);
  });
}

void FewVerdicts::note_destroyed(const Proxy& proxy, std::size_t size) {
  if (!are_known_) return;
  const std::uint32_t gone = proxy.position, last = std::uint32_t(size - 1);
  with_table([&](auto& table) {
    table.release(gone);
    table.moved.take(gone);
    if (gone != last) table.replace(gone, last);
  });
}

void FewVerdicts::note_told(std::size_t size) noexcept {
  if (are_known_) with_table([&](auto& table) { table.note_told(std::uint32_t(size)); });
}

/// A table that was outgrown is taken again once there is much room in it.
std::uint32_t FewVerdicts::room_for(std::size_t size) const {
  for (const std::uint32_t room : {VeryFew::most, Some::most})
    if (size <= (room == outgrown_ ? room - room / 4 : room)) return room;
  return Many::most;
}

bool FewVerdicts::is_worth_learning(std::size_t size, std::size_t moved, bool may_answer) {
  if (searches_left_ != 0) {
    --searches_left_;
    return false;
  }
  if (room_for(size) == VeryFew::most) return true;
  calm_ = moved <= most_moved(size) ? calm_ + 1 : 0;
  return calm_ >= least_calm && may_answer;
}

/// False if there is no memory.
bool FewVerdicts::make_room(std::uint32_t room) noexcept {
  if (room != Some::most) some_.reset();
  if (room != Many::most) many_.reset();
  const auto make = [](auto& table) {
    using Table = typename std::decay_t<decltype(table)>::element_type;
    if (!table) table.reset(new (std::nothrow) Table);
    return table != nullptr;
  };
  const bool is_made = room == VeryFew::most || (room == Some::most ? make(some_) : make(many_));
  room_ = is_made ? room : VeryFew::most;
  return is_made;
}

void FewVerdicts::learn(const Proxies& live, PairStore& pairs, std::size_t moved, bool may_answer) {
  are_known_ = false;
  if (live.size() > most) {
    give_back();
    return note_many();
  }
  if (!is_worth_learning(live.size(), moved, may_answer) || !make_room(room_for(live.size()))) return;
  are_known_ = true;
  with_table([&](auto& table) {
    table.moved = {};
    for (const Proxy* proxy : live) {
      table.add(proxy->position);
      table.set_box(proxy->position, box_in_world(*proxy));
    }
    for (std::uint32_t i = 0; i < pairs.size(); ++i)
      table.hold(position_of(pairs[i].m_pProxy0), position_of(pairs[i].m_pProxy1));
  });
}

template <class Table>
FewVerdicts::Answer FewVerdicts::compare(Table& table, const Proxies& live, bool by_masks) {
  const auto size = std::uint32_t(live.size());
  if (Table::most > VeryFew::most && table.moved.has_more_than(most_moved(size))) return Answer::unknown;
  Answer answer = Answer::still;
  table.forget_changes();
  table.moved.for_each([&](std::uint32_t mover) {
    if (answer == Answer::unknown) return;
    const auto box = table.box(mover);
    if (!box.is_valid()) {
      answer = Answer::unknown;
      return;
    }
    auto news = table.touching(box, size);
    for (std::uint32_t w = 0; w < Table::Set::count; ++w) news.words[w] ^= table.held(mover).words[w];
    news.take(mover);
    news.for_each([&](std::uint32_t other) {
      if (answer == Answer::unknown) return;
      if (!table.held(mover).has(other)) {
        const Proxy &a = *live[mover], &b = *live[other];
        if (!by_masks || a.has_new_filter() || b.has_new_filter()) {
          answer = Answer::unknown;
          return;
        }
        if (!accepts(a.world_filter, b.world_filter)) return;
      }
      answer = Answer::pairs;
      table.change(mover, other);
    });
  });
  return answer;
}

template <class Table>
void FewVerdicts::apply(Table& table, const Proxies& live, std::vector<btBroadphasePair>& begun) {
  begun.clear();
  has_any_ended_ = table.apply([&](std::uint32_t a, std::uint32_t b) { begun.emplace_back(*live[a], *live[b]); });
}

#define INSTANTIATE(Table)                                                         \
  template FewVerdicts::Answer FewVerdicts::compare(Table&, const Proxies&, bool); \
  template void FewVerdicts::apply(Table&, const Proxies&, std::vector<btBroadphasePair>&)
INSTANTIATE(FewVerdicts::VeryFew);
INSTANTIATE(FewVerdicts::Some);
INSTANTIATE(FewVerdicts::Many);
#undef INSTANTIATE

void FewVerdicts::give_back() noexcept {
  forget();
  make_room(VeryFew::most);
}

void FewVerdicts::validate(const Proxies& live, PairStore& pairs, const BasicWorld<btScalar>& world,
                           bool by_masks) const {
  const auto check = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  if (!are_known_) return;
  check(live.size() <= room_, "verdicts: of many proxies");
  const boxstream::detail::DefaultFloatEnvironment environment;
  std::size_t bits = 0;
  for (const Proxy* a : live)
    for (const Proxy* b : live) {
      if (a == b) continue;
      const auto [is_held, is_in_world, has_moved] = with_table([&](const auto& table) {
        return std::tuple(table.held(a->position).has(b->position), table.in_world(a->position).has(b->position),
                          table.moved.has(a->position) || table.moved.has(b->position));
      });
      check(is_in_world == (a->id && b->id && world.pair_place(a->id, b->id).has_value()),
            "verdicts: a pair of the World");

      const bool touch =
          is_valid(box_in_world(*a)) && is_valid(box_in_world(*b)) && overlaps(box_in_world(*a), box_in_world(*b));
      if (!is_held) {
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
