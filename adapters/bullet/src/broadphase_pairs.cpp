// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include "borrowed_cache.hpp"
#include "broadphase_impl.hpp"
#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// By its filter as it is. From now on a write of the filter fields shows, back to what the World has as well. The next
/// batch looks at the pairs of a proxy whose filter was new.
void Broadphase::Impl::note_refusal(Proxy& low, Proxy& high) const {
  may_refuse = true;
  for (Proxy* proxy : {&low, &high}) {
    if (!proxy->has_new_filter()) continue;
    proxy->world_filter = proxy->filter();
    proxy->world_filter.group = ~proxy->world_filter.group;
    has_new_filters = true;
  }
}

bool Broadphase::Impl::accepts(ProxyId a, ProxyId b) const {
  Proxy& low = proxy_of(a);
  Proxy& high = proxy_of(b);
  if (low.destroyed || high.destroyed) return false;
  if (own) {
    if (own->needsBroadphaseCollision(&low, &high)) return true;
    note_refusal(low, high);
    return false;
  }
  // Adding the pair applies the filter: the cache calls it once for each pair.
  require_room(*cache, 1);
  const int before = cache->getNumOverlappingPairs();
  const bool added = cache->addOverlappingPair(&low, &high) || cache->getNumOverlappingPairs() != before;
  if (!added) note_refusal(low, high);
  if (!low.destroyed && !high.destroyed) return added;
  // The filter destroyed one of the two and then accepted the pair.
  cache->removeOverlappingPair(&low, &high, nullptr);
  return false;
}

/// After a new filter callback was set, refused pairs are tested again.
void Broadphase::Impl::update_rule() {
  btOverlapFilterCallback* const callback = cache->getOverlapFilterCallback();
  const unsigned filters_set = own ? own->filters_set() : 0;
  if (is_rule_current && callback == known_callback && filters_set == known_filters_set) return;
  default_rule = own && !callback;
  for (Proxy* proxy : live) update_filter(*proxy, proxy->filter());
  is_rule_current = true;
  known_callback = callback;
  known_filters_set = filters_set;
}

/// Looks at the next `count` proxies of a rotation through all.
bool Broadphase::Impl::has_written_filter(std::size_t count) {
  if (next_checked >= live.size() || count >= live.size()) next_checked = 0;
  const auto first = live.begin() + std::ptrdiff_t(next_checked);
  next_checked = std::min(live.size(), next_checked + count);
  return std::any_of(first, live.begin() + std::ptrdiff_t(next_checked),
                     [](const Proxy* proxy) { return proxy->has_new_filter(); });
}

/// Passes group and mask fields that users have written on to the World.
void Broadphase::Impl::update_filters() {
  if (!has_new_filters && !(may_refuse && has_written_filter(count_to_check()))) return;
  for (Proxy* proxy : live)
    if (proxy->has_new_filter()) update_filter(*proxy, proxy->filter());
  has_new_filters = false;
}

/// With an own cache.
bool Broadphase::Impl::is_rule_known() const {
  return is_rule_current && own->getOverlapFilterCallback() == known_callback &&
         own->filters_set() == known_filters_set;
}

/// True if a batch would change nothing, which takes a time that does not depend on the number of proxies.
bool Broadphase::Impl::is_still_quiet() {
  if (!own || !is_quiet || !own->is_settled() || !is_rule_known()) return false;
  if (!may_refuse) return !has_new_filters;
  has_new_filters = has_new_filters || has_written_filter_in_quiet();
  return !has_new_filters;
}

bool Broadphase::Impl::has_written_filter_in_quiet() {
  const bool all_are_checked = live.size() > checked_if_few && checked_since_change >= live.size();
  const std::size_t count = all_are_checked ? checked_in_quiet : count_to_check();
  checked_since_change += count;
  return has_written_filter(count);
}

/// True if few boxes have moved, or have come and gone, and what begins and ends is done.
bool Broadphase::Impl::is_done_by_few(btDispatcher* dispatcher) {
  if (live.size() > FewVerdicts::most || !own || options.method == Method::hybrid) return false;
  constexpr std::size_t most_pending = 4 * FewVerdicts::most;  // with those of proxies that are gone
  const bool are_sound = own->is_settled() && is_rule_known() && stats.invalid == 0 && !has_new_filters &&
                         !surroundings.are_kept() && pending.size() <= most_pending;
  if (!are_sound) return false;
  has_new_filters = may_refuse && has_written_filter_in_quiet();
  if (has_new_filters) return false;
  // Should a box go back to the one that the World has, a callback has to be asked about it all the same.
  std::size_t moved = 0;
  const FewVerdicts::Answer answer = or_fatal([&] {
    return few_verdicts.ask(live, default_rule, early, [&](const Proxy& proxy) {
      ++moved;
      if (!default_rule) world.refilter(proxy.id);
    });
  });
  if (answer == FewVerdicts::Answer::unknown) return false;
  stats.proxies = live.size();
  stats.pairs = own->store().size();
  stats.moved = moved;
  stats.begun = stats.ended = 0;
  stats.search = {};
  if (answer != FewVerdicts::Answer::pairs) {
    is_quiet = answer == FewVerdicts::Answer::nothing;
    return true;
  }
  or_fatal([&] {
    if (few_verdicts.has_any_ended())
      own->end([this](const btBroadphasePair& pair) { return few_verdicts.has_ended(pair); });
    own->begin(early);
  });
  world_lags = true;
  checked_since_change = 0;
  stats.begun = early.size();
  stats.ended = stats.pairs + stats.begun - own->store().size();
  stats.pairs = own->store().size();
  own->flush_notifications(dispatcher);
  return true;
}

/// Tells the World of the pairs that few proxies hold. In the next update it decides anew about those that it did not
/// know of, for boxes may have gone away and come back, and about those that users have changed.
void Broadphase::Impl::catch_up() {
  if (!world_lags) return;
  assert(!rooms.are_open() && !surroundings.are_kept());
  flush_pending();
  const auto decide_anew = [this](ProxyId a, ProxyId b) {
    world.refilter(a);
    world.refilter(b);
  };
  if (!own->user_changes().empty()) {
    few_verdicts.forget();
    all_have_begun = false;
    own->user_changes().flush(decide_anew);
  }
  own->settle();
  find_untold();
  world.update_told(begun, ended, [](ProxyId, ProxyId) { return true; });
  for (const auto* told : {&begun, &ended})
    for (const ProxyPair& pair : *told) decide_anew(pair.a, pair.b);
  few_verdicts.note_told(live.size());
  world_lags = false;
}

/// The pairs that are held and not in the World, to `begun`, and the others, to `ended`.
void Broadphase::Impl::find_untold() {
  begun.clear();
  ended.clear();
  if (few_verdicts.are_known()) {
    const auto to = [](std::vector<ProxyPair>& told) {
      return [&told](const Proxy& a, const Proxy& b) { told.push_back({a.id, b.id}); };
    };
    return few_verdicts.for_each_untold(live, to(begun), to(ended));
  }
  PairStore& pairs = own->store();
  for (std::uint32_t i = 0; i < pairs.size(); ++i)
    if (!place_in(world, pairs[i]))
      begun.push_back(
          {static_cast<const Proxy*>(pairs[i].m_pProxy0)->id, static_cast<const Proxy*>(pairs[i].m_pProxy1)->id});
  world.for_each_pair([&](ProxyPair pair) {
    assert(world.contains(pair.a) && world.contains(pair.b));
    if (pairs.find(proxy_of(pair.a), proxy_of(pair.b)) == PairStore::npos) ended.push_back(pair);
    return true;
  });
}

void Broadphase::Impl::update_filter(Proxy& proxy, Filter filter) {
  proxy.world_filter = filter;
  note_filter(filter_for_world(proxy));
  world.set_filter(proxy.id, filter_for_world(proxy));
  world.refilter(proxy.id);
}

/// Releases pairs that users added or removed. `thoroughly` takes a pass over all pairs of a borrowed cache; without
/// it, changes that keep the number of pairs are not noticed.
void Broadphase::Impl::release_user_changes(btDispatcher* dispatcher, bool thoroughly) {
  if (own && own->user_changes().empty()) return;
  few_verdicts.forget();
  catch_up();
  all_have_begun = false;
  surroundings.forget_held();
  if (own) return own->user_changes().flush([this](ProxyId a, ProxyId b) { world.release(a, b); });
  if (thoroughly || std::size_t(cache->getNumOverlappingPairs()) != snapshot.size())
    reconcile(*cache, snapshot, world, dispatcher);
}

void Broadphase::Impl::update_pairs(btDispatcher* dispatcher) {
  if (!computes_pairs || world_is_busy || is_ending) return;
  // Before rooms, whose answer would be lost if a callback threw.
  if (own) own->flush_notifications(dispatcher);
  if (rooms.are_open() ? ask_rooms() == RoomsAnswer::nothing : is_still_quiet() || is_done_by_few(dispatcher)) return;
  or_fatal([&] { find_events(dispatcher); });
  own ? own->flush_notifications(dispatcher) : end_in_borrowed(dispatcher);
}

void Broadphase::Impl::find_events(btDispatcher* dispatcher) {
  is_quiet = false;  // whatever is thrown
  struct CloseUnlessDone {
    Impl* impl;
    ~CloseUnlessDone() {
      if (impl == nullptr) return;
      impl->close_rooms();
      impl->few_verdicts.forget();
    }
  } guard{this};
  catch_up();
  bool are_told = false, are_searched = false;
  if (rooms.are_open()) {
    own->prepare(world);  // before filters are asked, for they might remove pairs
    ask_about_begun();
    tell(begun, rooms.ended());
  } else if (can_only_end()) {
    find_ended();
    own->prepare(world);
    tell({}, ended);
    stats.moved = std::min(answered, live.size());
    are_told = true;
  } else {
    all_have_begun = false;
    flush_alone();
    release_user_changes(dispatcher, true);
    update_rule();
    update_filters();
    if (own) own->prepare(world);
    const InWorld busy(*this);
    stats = world.update([&](ProxyId a, ProxyId b) { return accepts(a, b); });
    are_searched = true;
  }
  if (surroundings.are_kept()) note_ended();
  if (own) {
    own->follow(world);
    constexpr unsigned least = 10;  // memory that is not needed goes back in the first of them
    const bool is_still = stats.moved == 0 && stats.begun == 0 && stats.ended == 0;
    still_batches = is_still ? still_batches + 1 : 0;
    is_quiet = still_batches >= least && !has_pending.load(std::memory_order_relaxed);
    checked_since_change = 0;
    free_destroyed();
    all_have_begun = are_told || !has_pending.load(std::memory_order_relaxed);
    answered = 0;
    follow_rooms();
    if (are_searched && pending.empty() && options.method != Method::hybrid)
      few_verdicts.learn(live, own->store(), stats.moved,
                         default_rule && stats.invalid == 0 && !surroundings.are_kept());
    else
      few_verdicts.forget();
  }
  surroundings.note_batch();
  guard.impl = nullptr;
}

/// Of the pairs that begin by rooms, those that filters accept, to `begun`. They are asked in the order of the World,
/// and not within it, as they may query.
void Broadphase::Impl::ask_about_begun() {
  begun.assign(rooms.begun().begin(), rooms.begun().end());
  const auto order = [this](ProxyId id) { return proxy_of(id).created; };
  for (ProxyPair& pair : begun)
    if (order(pair.b) < order(pair.a)) std::swap(pair.a, pair.b);
  std::sort(begun.begin(), begun.end(), [&](const ProxyPair& x, const ProxyPair& y) {
    return std::pair(order(x.a), order(x.b)) < std::pair(order(y.a), order(y.b));
  });
  const Busy busy(*this);
  begun.erase(
      std::remove_if(begun.begin(), begun.end(), [&](const ProxyPair& pair) { return !accepts(pair.a, pair.b); }),
      begun.end());
}

/// Tells the World of pairs that begin and end by boxes that it does not have yet. Should a box go back to the one that
/// the World has, its search has to look at the pair all the same.
void Broadphase::Impl::tell(Span<const ProxyPair> begin, Span<const ProxyPair> end) {
  stats = world.update_told(begin, end, [](ProxyId, ProxyId) { return true; });
  for (const Span<const ProxyPair> told : {begin, end})
    for (const ProxyPair& pair : told)
      for (const ProxyId id : {pair.a, pair.b})
        if (const Proxy& proxy = proxy_of(id); rooms.differs(proxy) || pending.contains(proxy)) world.refilter(id);
}

void Broadphase::Impl::note_ended() {
  for (const ProxyPair& pair : world.ended()) {
    const Proxy *const a = live_proxy_of(world, pair.a), *const b = live_proxy_of(world, pair.b);
    if (a != nullptr && b != nullptr && !a->destroyed && !b->destroyed) surroundings.note_ended(*a, *b);
  }
}

/// What began is in the cache already: see accepts.
void Broadphase::Impl::end_in_borrowed(btDispatcher* dispatcher) {
  if (!world.changes().empty()) {
    const Busy busy(*this);
    if (cache->hasDeferredRemoval()) {
      remove_deferred(*cache, world, dispatcher);
    } else {
      // Pairs of destroyed proxies have left the cache already.
      for (const ProxyPair& pair : world.ended())
        if (world.contains(pair.a) && world.contains(pair.b) && !proxy_of(pair.a).destroyed &&
            !proxy_of(pair.b).destroyed)
          cache->removeOverlappingPair(&proxy_of(pair.a), &proxy_of(pair.b), dispatcher);
    }
  }
  or_fatal([&] {
    const bool only_grew = world.ended().empty() && !cache->hasDeferredRemoval();  // otherwise pairs have moved
    if (!world.changes().empty()) only_grew ? snapshot.add_new(*cache) : snapshot.capture(*cache);
    free_destroyed();
  });
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
