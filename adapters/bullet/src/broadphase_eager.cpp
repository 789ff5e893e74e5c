// SPDX-License-Identifier: MIT
// Pairs that begin within moves.
#include <algorithm>
#include <utility>

#include "broadphase_impl.hpp"
#include "client.hpp"
#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

bool is_ghost(const void* client) {
  const btCollisionObject* const object = as_object(client);
  return object != nullptr && object->getInternalType() == btCollisionObject::CO_GHOST_OBJECT;
}

Proxy& other_of(const btBroadphasePair& pair, const Proxy& proxy) {
  return *static_cast<Proxy*>(pair.m_pProxy0 == &proxy ? pair.m_pProxy1 : pair.m_pProxy0);
}

}  // namespace

bool Broadphase::Impl::wants_eager(Proxy& proxy) const {
  if (options.eager == Eager::all) return true;
  if (proxy.m_clientObject != proxy.checked_client) {
    proxy.checked_client = proxy.m_clientObject;
    proxy.is_ghost = is_ghost(proxy.m_clientObject);
  }
  return proxy.is_ghost;
}

void Broadphase::Impl::begin_eagerly(Proxy& proxy, const Box& settled, btDispatcher* dispatcher) {
  if (!computes_pairs || world_is_busy || is_ending || !wants_eager(proxy)) {
    all_have_begun = false;
    return;
  }
  ++answered;
  early.clear();
  if (!rooms.are_open() || !begin_among_candidates(proxy)) {
    close_rooms();
    is_quiet = false;
    or_fatal([&] {
      release_user_changes(dispatcher, false);
      catch_up();
      surroundings.give_up_crowd();
      if (!surroundings.are_kept() && surroundings.note_search(live.size())) keep_surroundings();
      surroundings.are_kept() ? begin_among_neighbours(proxy, settled) : begin_by_search(proxy, settled);
    });
  }
  if (!early.empty()) few_verdicts.forget();
  if (own && early.empty() && destroyed.empty()) return;
  if (own) {
    const Busy busy(*this);
    own->begin_early(early, dispatcher);
  } else {
    or_fatal([&] { snapshot.add_new(*cache); });
  }
  or_fatal([&] { free_destroyed(); });
}

/// By candidates of rooms, if they are all that it may touch. False if something else has to do it.
bool Broadphase::Impl::begin_among_candidates(Proxy& proxy) {
  if (!own || has_new_filters || !own->user_changes().empty() || !or_fatal([&] { return rooms.come_near(live); }))
    return false;
  or_fatal([&] {
    rooms.for_each_more(live, proxy, [&](Proxy& other) { early.emplace_back(proxy, other); });
    const bool are_accepted = begin_found(proxy);
    if (!rooms.are_open()) return;  // a filter has destroyed a proxy, or created one
    for (const btBroadphasePair& pair : early) rooms.note_begun(proxy, other_of(pair, proxy));
    if (!are_accepted) close_rooms();  // what is refused is asked about in each move
  });
  return true;
}

void Broadphase::Impl::keep_surroundings() {
  surroundings.begin(live.size());
  for (Proxy* proxy : live) surroundings.note_created(*proxy, box_in_world(*proxy));
}

void Broadphase::Impl::begin_among_neighbours(Proxy& proxy, const Box& settled) {
  surroundings.for_each_more(proxy, settled, [&](Proxy& other) {
    if (proxy.id && other.id && world.pair_place(proxy.id, other.id)) return true;
    early.emplace_back(proxy, other);
    return false;
  });
  if (early.empty()) return;
  if (pending.are_created()) flush_pending();
  begin_found(proxy);
}

void Broadphase::Impl::begin_by_search(Proxy& proxy, const Box& settled) {
  flush_pending();
  const InWorld busy(*this);
  try {
    world.begin_pairs_of(
        proxy.id, [&](ProxyId a, ProxyId b) { return accepts(a, b); },
        [&](ProxyPair pair) { early.emplace_back(proxy_of(pair.a), proxy_of(pair.b)); }, true, settled);
  } catch (...) {
    release_early(early.size());
    throw;
  }
}

/// Begins the pairs in `early`, which are of one proxy, in the order of creation; those that do not begin leave it.
/// False if one was refused.
bool Broadphase::Impl::begin_found(Proxy& proxy) {
  if (early.empty()) return true;
  std::sort(early.begin(), early.end(), [&](const btBroadphasePair& x, const btBroadphasePair& y) {
    return other_of(x, proxy).created < other_of(y, proxy).created;
  });
  const Busy busy(*this);
  // Should it go back to the box that the World has before this gets another one, its pairs have to end all the same.
  world.refilter(proxy.id);
  std::size_t count = 0;
  bool are_accepted = true;
  try {
    for (const btBroadphasePair& pair : early) {
      Proxy& other = other_of(pair, proxy);
      const bool is_first = proxy.created < other.created;
      if (!accepts(is_first ? proxy.id : other.id, is_first ? other.id : proxy.id))
        are_accepted = false;
      else if (world.begin_told(proxy.id, other.id))
        early[count++] = pair;
    }
  } catch (...) {
    release_early(count);
    throw;
  }
  early.resize(count);
  return are_accepted;
}

/// After an exception from a filter: the cache does not get these pairs, so that the next batch must find them again.
void Broadphase::Impl::release_early(std::size_t count) {
  all_have_begun = false;
  for (std::size_t i = 0; i < count; ++i)
    world.release(static_cast<Proxy*>(early[i].m_pProxy0)->id, static_cast<Proxy*>(early[i].m_pProxy1)->id);
}

/// True if the next batch is known to begin nothing, and a look at all pairs is less than a search. Where filters
/// refuse pairs, all that a proxy touches were asked about in its last move, unless it is settled. Boxes go on to be
/// pending.
bool Broadphase::Impl::can_only_end() {
  if (!own || !all_have_begun || !surroundings.are_kept() || pending.are_created() || has_new_filters) return false;
  constexpr std::size_t pairs_of_move = 8;
  if (own->store().size() > pairs_of_move * answered || !own->user_changes().empty() || !is_rule_known()) return false;
  if (!may_refuse) return true;
  if (options.eager == Eager::all) return false;
  has_new_filters = has_written_filter(count_to_check());
  return !has_new_filters;
}

void Broadphase::Impl::find_ended() {
  ended.clear();
  const boxstream::detail::DefaultFloatEnvironment environment;
  PairStore& pairs = own->store();
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const auto &a = static_cast<const Proxy&>(*pairs[i].m_pProxy0), &b = static_cast<const Proxy&>(*pairs[i].m_pProxy1);
    if (!surroundings.touch(a, b)) ended.push_back({a.id, b.id});
  }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
