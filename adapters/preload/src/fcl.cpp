// SPDX-License-Identifier: MIT
// Replaces the managers that FCL's library has for doubles. The object stays FCL's, made and ended by FCL's own
// functions, so that its layout, its vtable and classes derived from it hold; it stays empty.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <boxstream/fcl.hpp>

#include "backend.hpp"
#include "fcl_check.hpp"
#include "registry.hpp"

namespace boxstream::preload {
namespace {

using Base = ::fcl::BroadPhaseCollisionManager<double>;
using Ours = fcl::CollisionManager<double>;

Front front;
bool keeps_order = false;  // callbacks come in the order in which FCL's manager finds pairs
bool keeps_own = false;    // FCL's manager is kept up to date beside ours

struct Stand {
  Ours ours;
};

Registry<Stand> stands;

template <class T>
T* pointer(Word word) {
  return reinterpret_cast<T*>(word);
}

/// Counts what is called back.
template <class Callback>
struct Counted {
  Callback callback;
  void* data;

  static bool on_collide(Object* a, Object* b, void* to) {
    auto& counted = *static_cast<Counted*>(to);
    front.tally->pairs.fetch_add(1, std::memory_order_relaxed);
    return counted.callback(a, b, counted.data);
  }
  static bool on_distance(Object* a, Object* b, void* to, double& distance) {
    auto& counted = *static_cast<Counted*>(to);
    front.tally->pairs.fetch_add(1, std::memory_order_relaxed);
    return counted.callback(a, b, counted.data, distance);
  }
};

/// The manager that a query is to be asked of, in place of the one that the program names.
Base* in_place_of(Base* manager) {
  Stand* const stand = stands.find(manager);
  return stand ? &stand->ours : manager;
}

// The query of `member` with other data and another callback, at ours.
void ask_ours(const Ours& ours, FclMember member, Word subject, void* data, OnCollide callback) {
  switch (member) {
    case FclMember::collide_all:
      return ours.collide(data, callback);
    case FclMember::collide_one:
      return ours.collide(pointer<Object>(subject), data, callback);
    default:
      return ours.collide(in_place_of(pointer<Base>(subject)), data, callback);
  }
}

void ask_ours(const Ours& ours, FclMember member, Word subject, void* data, OnDistance callback) {
  switch (member) {
    case FclMember::distance_all:
      return ours.distance(data, callback);
    case FclMember::distance_one:
      return ours.distance(pointer<Object>(subject), data, callback);
    default:
      return ours.distance(in_place_of(pointer<Base>(subject)), data, callback);
  }
}

bool is_distance(FclMember member) {
  return member >= FclMember::distance_all;
}
bool has_subject(FclMember member) {
  return member != FclMember::collide_all && member != FclMember::distance_all;
}

/// FCL's own query, with other data and another callback.
template <class Callback>
void ask_own(unsigned site, FclMember member, Words w, void* data, Callback callback) {
  const int at = has_subject(member) ? 2 : 1;
  w.at[at] = reinterpret_cast<Word>(data);
  w.at[at + 1] = reinterpret_cast<Word>(callback);
  front.own(site, w);
}

template <class Callback>
void query(unsigned site, FclMember member, const Words& w, const Ours* ours) {
  const int at = has_subject(member) ? 2 : 1;
  Counted<Callback> counted{reinterpret_cast<Callback>(w.at[at + 1]), pointer<void>(w.at[at])};
  if constexpr (std::is_same_v<Callback, OnCollide>) {
    if (!ours) return ask_own(site, member, w, &counted, &Counted<Callback>::on_collide);
    if (keeps_own) {
      const auto by_own = [&](Found& found) { ask_own(site, member, w, &found, &Found::note); };
      const auto by_ours = [&](Found& found) { ask_ours(*ours, member, w.at[1], &found, &Found::note); };
      const Pairs pairs = check_pairs(front, by_own, by_ours);
      if (keeps_order) {
        for (const auto& [a, b] : pairs) {
          if (Counted<Callback>::on_collide(a, b, &counted)) return;
        }
        return;
      }
    }
    ask_ours(*ours, member, w.at[1], &counted, &Counted<Callback>::on_collide);
  } else {
    if (!ours) return ask_own(site, member, w, &counted, &Counted<Callback>::on_distance);
    if (keeps_own) {
      const auto by_own = [&](Nearest& found) { ask_own(site, member, w, &found, &Nearest::note); };
      const auto by_ours = [&](Nearest& found) { ask_ours(*ours, member, w.at[1], &found, &Nearest::note); };
      check_distance(front, by_own, by_ours);
    }
    ask_ours(*ours, member, w.at[1], &counted, &Counted<Callback>::on_distance);
  }
}

bool is_query(FclMember member) {
  return member >= FclMember::collide_all;
}

Word serve(unsigned site, unsigned, unsigned number, const Words& w) {
  const auto member = static_cast<FclMember>(number);
  auto* const self = pointer<Base>(w.at[0]);
  if (member == FclMember::construct || member == FclMember::construct_base) {
    front.own(site, w);
    if (front.mode != Mode::measure) stands.add(self, std::make_unique<Stand>());
    return 0;
  }
  if (member == FclMember::destroy || member == FclMember::destroy_base || member == FclMember::destroy_and_free) {
    stands.remove(self);
    return front.own(site, w);
  }
  Stand* const stand = stands.find(self);
  if (is_query(member)) {
    const Ours* const ours = stand ? &stand->ours : nullptr;
    is_distance(member) ? query<OnDistance>(site, member, w, ours) : query<OnCollide>(site, member, w, ours);
    return 0;
  }
  if (!stand) return front.own(site, w);
  Ours& ours = stand->ours;
  auto* const object = pointer<Object>(w.at[1]);
  const auto& objects = *pointer<const std::vector<Object*>>(w.at[1]);
  if (keeps_own && member < FclMember::get_objects) front.own(site, w);
  switch (member) {
    case FclMember::register_object:
      ours.registerObject(object);
      return 0;
    case FclMember::register_objects:
      ours.registerObjects(objects);
      return 0;
    case FclMember::unregister_object:
      ours.unregisterObject(object);
      return 0;
    case FclMember::setup:
      ours.setup();
      return 0;
    case FclMember::update_all:
      ours.update();
      return 0;
    case FclMember::update_one:
      ours.update(object);
      return 0;
    case FclMember::update_some:
      ours.update(objects);
      return 0;
    case FclMember::clear:
      ours.clear();
      return 0;
    case FclMember::get_objects:
      ours.getObjects(*pointer<std::vector<Object*>>(w.at[1]));
      return 0;
    case FclMember::size:
      return ours.size();
    case FclMember::empty:
      return ours.empty();
    default:
      return 0;
  }
}

}  // namespace
}  // namespace boxstream::preload

extern "C" __attribute__((visibility("default"))) boxstream::preload::Backend boxstream_preload_backend(
    const boxstream::preload::Front& front) {
  namespace preload = boxstream::preload;
  preload::front = front;
  const char* const order = std::getenv("BOXSTREAM_TRY_ORDER");
  preload::keeps_order = front.mode == preload::Mode::check || front.mode == preload::Mode::replace
                             ? order && std::strcmp(order, "engine") == 0
                             : false;
  preload::keeps_own = front.mode == preload::Mode::check || preload::keeps_order;
  return {preload::serve};
}
