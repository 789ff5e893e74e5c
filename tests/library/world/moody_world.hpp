// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <thread>
#include <type_traits>
#include <utility>

#include "float_environment.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

/// A World each call of which comes in another floating-point environment, some queries from another thread. Visitors
/// must find the environment of their caller.
template <class S>
class MoodyWorld {
 public:
  using World = detail::WorldCore<S>;
  using Box = BasicAabb<S>;

  MoodyWorld(WorldOptions options, detail::SearchMode mode, unsigned seed) : world_(options, mode), random_(seed) {}

  ProxyId create(const Box& box, Filter filter = {}, std::uint64_t user = 0) {
    return in_some_mood([&](const Mood&) { return world_.create(box, filter, user); });
  }
  void create(Span<const Box> boxes, Span<const Filter> filters, Span<ProxyId> out, Span<const std::uint64_t> users) {
    in_some_mood([&](const Mood&) { world_.create(boxes, filters, out, users); });
  }
  template <class Ids>
  auto destroy(const Ids& ids) {
    return in_some_mood([&](const Mood&) { return world_.destroy(ids); });
  }
  void clear() { world_.clear(); }
  void shrink_to_fit() { world_.shrink_to_fit(); }
  template <class Ids, class Boxes>
  auto move(const Ids& ids, const Boxes& boxes) {
    return in_some_mood([&](const Mood&) { return world_.move(ids, boxes); });
  }
  bool set_filter(ProxyId id, Filter filter) { return world_.set_filter(id, filter); }
  bool refilter(ProxyId id) { return world_.refilter(id); }
  void refilter() { world_.refilter(); }
  bool set_user(ProxyId id, std::uint64_t user) { return world_.set_user(id, user); }
  bool contains(ProxyId id) const { return world_.contains(id); }
  std::size_t size() const { return world_.size(); }
  Box box(ProxyId id) const { return world_.box(id); }
  Filter filter(ProxyId id) const { return world_.filter(id); }
  std::uint64_t user(ProxyId id) const { return world_.user(id); }

  WorldStats update() {
    return in_some_mood([&](const Mood&) { return world_.update(); });
  }
  WorldStats update(ProxyPairFilter accept) {
    return in_some_mood([&](const Mood& mood) {
      return world_.update([&](ProxyId a, ProxyId b) {
        EXPECT_TRUE(mood.is_on());
        return accept(a, b);
      });
    });
  }
  Span<const ProxyPair> begun() const { return world_.begun(); }
  Span<const ProxyPair> ended() const { return world_.ended(); }
  Splice changes() const { return world_.changes(); }
  std::optional<std::uint32_t> pair_place(ProxyId a, ProxyId b) const { return world_.pair_place(a, b); }
  std::uint64_t pair_count() const { return world_.pair_count(); }
  void for_each_pair(FunctionRef<bool(ProxyPair)> visit) const { world_.for_each_pair(visit); }
  void stream_pairs(ProxyPairSink sink) const { world_.stream_pairs(sink); }
  void begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin) {
    in_some_mood([&](const Mood&) { world_.begin_pairs_of(id, accept, begin); });
  }
  bool release(ProxyId a, ProxyId b) { return world_.release(a, b); }

  void query_box(const Box& box, ProxyVisitor visit) const {
    on_some_thread([&](const Mood& mood) {
      world_.query_box(box, [&](ProxyId id) {
        EXPECT_TRUE(mood.is_on());
        return visit(id);
      });
    });
  }
  void query_planes(Span<const BasicPlane<S>> planes, ProxyVisitor visit) const {
    on_some_thread([&](const Mood& mood) {
      world_.query_planes(planes, [&](ProxyId id) {
        EXPECT_TRUE(mood.is_on());
        return visit(id);
      });
    });
  }
  void query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) const {
    on_some_thread([&](const Mood& mood) {
      world_.query_ray(ray, [&](ProxyId id, S enter, S length) {
        EXPECT_TRUE(mood.is_on());
        return visit(id, enter, length);
      });
    });
  }
  std::size_t query_nearest(const S (&point)[3], Span<ProxyId> out) const {
    std::size_t count = 0;
    on_some_thread([&](const Mood&) { count = world_.query_nearest(point, out); });
    return count;
  }
  void query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const {
    on_some_thread([&](const Mood& mood) {
      world_.query_nearest_box(box, limit, [&](ProxyId id, S distance) {
        EXPECT_TRUE(mood.is_on());
        return visit(id, distance);
      });
    });
  }
  void nearest_pairs(const MoodyWorld& other, S limit, NearPairVisitor<S> visit) const {
    on_some_thread([&](const Mood& mood) {
      world_.nearest_pairs(other.world_, limit, [&](ProxyPair pair, S distance) {
        EXPECT_TRUE(mood.is_on());
        return visit(pair, distance);
      });
    });
  }
  Box bounds() const {
    return in_some_mood([&](const Mood&) { return world_.bounds(); });
  }
  void validate() const {
    in_some_mood([&](const Mood&) { world_.validate(); });
  }

 private:
  template <class Call>
  auto in_some_mood(Call&& call) const {
    const Mood mood(static_cast<unsigned>(random_() >> 8) % Mood::count);
    return call(mood);
  }

  template <class Call>
  void on_some_thread(Call&& call) const {
    if (random_() >> 8 & 7)
      in_some_mood(call);
    else
      std::thread([&] { in_some_mood(call); }).join();
  }

  World world_;
  mutable std::minstd_rand random_;
};

}  // namespace boxstream::tests
