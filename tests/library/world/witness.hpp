// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "model.hpp"
#include "nearest/nearest_distance.hpp"
#include "values.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

/// A World and its model side by side, and all that can be seen of both without changing them.
template <class S, class World>
class Witness {
 public:
  /// The box that stands for a number.
  using BoxOf = std::function<BasicAabb<S>(unsigned)>;

  Witness(World& world, bool sticky, BoxOf box_of) : world_(world), model_(sticky), box_of_(std::move(box_of)) {}

 protected:
  ProxyId id(Birth b) const { return model_.proxies()[b].id; }
  Births births(ProxyPair p) const { return {model_.birth(p.a), model_.birth(p.b)}; }

  void query(unsigned value) {
    const auto box = box_of_(value);
    compare_in_box(box);

    const auto ray = ray_from<S>(value);
    std::map<Birth, S> on_ray;
    world_.query_ray(ray, [&](ProxyId p, S enter, S length) {
      EXPECT_TRUE(on_ray.emplace(model_.birth(p), enter).second) << "met twice";
      return length;
    });
    EXPECT_EQ(on_ray, model_.on_ray(ray));

    const BasicPlane<S> both[] = {{{box.min[0], box.max[1], box.min[2]}, box.max[0]},
                                  {{-box.max[2], box.min[0], 1}, S(value % 7)}};
    const Span<const BasicPlane<S>> planes(both, value % 3);
    std::vector<Birth> in_planes, not_behind;
    world_.query_planes(planes, [&](ProxyId p) {
      in_planes.push_back(model_.birth(p));
      return true;
    });
    for (const Birth b : model_.alive()) {
      const BasicAabb<S>& each = model_.proxies()[b].box;
      const auto rejects = [&](const BasicPlane<S>& plane) { return is_behind(each, plane); };
      if (makes_sense(each) && std::none_of(planes.begin(), planes.end(), rejects)) not_behind.push_back(b);
    }
    std::sort(in_planes.begin(), in_planes.end());
    std::sort(not_behind.begin(), not_behind.end());
    EXPECT_EQ(in_planes, not_behind);

    const S point[3] = {box.min[0], box.max[1], box.min[2]};
    std::vector<ProxyId> nearest(value % 50);
    nearest.resize(world_.query_nearest(point, Span<ProxyId>(nearest)));
    std::vector<Birth> near;
    for (const ProxyId p : nearest) near.push_back(model_.birth(p));
    EXPECT_EQ(near, model_.nearest(point, value % 50));

    BasicAabb<S> all = detail::ProxyTable<S>::inert_box();
    for (const Birth b : model_.alive())
      if (makes_sense(model_.proxies()[b].box)) all = merged(all, model_.proxies()[b].box);
    EXPECT_TRUE(world_.bounds() == all);
  }

  void compare_in_box(const BasicAabb<S>& box) {
    std::vector<Birth> in_box;
    world_.query_box(box, [&](ProxyId p) {
      in_box.push_back(model_.birth(p));
      return true;
    });
    std::sort(in_box.begin(), in_box.end());
    EXPECT_EQ(in_box, model_.in_box(box));
  }

  /// What a query by distance says, in any order. Of one box the second birth is 0.
  using Visits = std::vector<std::pair<S, Births>>;

  void distances(unsigned value) {
    const auto box = box_of_(value);
    const S limit = value % 5 == 4 ? std::numeric_limits<S>::infinity() : S(value % 5);
    Visits is, ought;
    const auto expect = [&](Birth a, Birth b, const BasicAabb<S>& x, const BasicAabb<S>& y) {
      const S distance = makes_sense(x) && makes_sense(y) ? detail::distance_below(x, y) : limit;
      if (distance < limit) ought.push_back({distance, {a, b}});
    };
    const auto compare = [&] {
      std::sort(is.begin(), is.end());
      std::sort(ought.begin(), ought.end());
      EXPECT_EQ(is, ought);
      is.clear();
      ought.clear();
    };
    const auto living = model_.alive();
    for (const Birth b : living) expect(b, 0, box, model_.proxies()[b].box);
    world_.query_nearest_box(box, limit, [&](ProxyId p, S distance) {
      is.push_back({distance, {model_.birth(p), 0}});
      return limit;
    });
    compare();
    for (std::size_t i = 0; i < living.size(); ++i)
      for (std::size_t j = i + 1; j < living.size(); ++j) {
        const auto &p = model_.proxies()[living[i]], &q = model_.proxies()[living[j]];
        if (permit(p.filter, q.filter)) expect(living[i], living[j], p.box, q.box);
      }
    world_.nearest_pairs(world_, limit, [&](ProxyPair pair, S distance) {
      is.push_back({distance, births(pair)});
      return limit;
    });
    compare();
  }

  /// Every box is found by its own bounds, beside all other queries.
  void compare_all(unsigned value) {
    compare_state();
    for (const Birth b : model_.alive()) compare_in_box(model_.proxies()[b].box);
    query(value);
    distances(value);
  }

  void stale(unsigned which) {
    for (const auto& proxy : model_.proxies()) {
      if (proxy.alive) continue;
      EXPECT_FALSE(world_.contains(proxy.id));
      EXPECT_FALSE(world_.move(proxy.id, proxy.box));
      EXPECT_FALSE(world_.set_filter(proxy.id, {}));
      EXPECT_FALSE(world_.set_user(proxy.id, 1));
      EXPECT_FALSE(world_.refilter(proxy.id));
      if (which % 2 == 0)
        world_.begin_pairs_of(
            proxy.id, [](ProxyId, ProxyId) { return true; }, [](ProxyPair) { FAIL(); });
    }
    EXPECT_FALSE(world_.contains({}));
    EXPECT_FALSE(world_.destroy(ProxyId{}));
  }

  std::vector<Births> all_births(Span<const ProxyPair> pairs) const {
    std::vector<Births> all;
    for (const ProxyPair p : pairs) all.push_back(births(p));
    return all;
  }

  void compare_state() {
    ASSERT_NO_THROW(world_.validate());
    const auto living = model_.alive();
    ASSERT_EQ(world_.size(), living.size());
    for (const Birth b : living) {
      const auto& proxy = model_.proxies()[b];
      ASSERT_TRUE(world_.contains(proxy.id));
      EXPECT_EQ(world_.user(proxy.id), proxy.user);
      EXPECT_EQ(world_.filter(proxy.id).group, proxy.filter.group);
      EXPECT_EQ(world_.filter(proxy.id).mask, proxy.filter.mask);
      if (makes_sense(proxy.box))
        EXPECT_TRUE(world_.box(proxy.id) == proxy.box);
      else
        EXPECT_FALSE(makes_sense(world_.box(proxy.id)));
    }
    std::vector<Births> held;
    world_.for_each_pair([&](ProxyPair p) {
      held.push_back(births(p));
      return true;
    });
    EXPECT_EQ(held, std::vector<Births>(model_.held().begin(), model_.held().end()));
    std::vector<Births> streamed;
    world_.stream_pairs([&](Span<const ProxyPair> pairs) {
      EXPECT_FALSE(pairs.empty());
      for (const ProxyPair p : pairs) streamed.push_back(births(p));
      return true;
    });
    EXPECT_EQ(streamed, held);
    EXPECT_EQ(world_.pair_count(), held.size());
  }

  World& world_;
  Model<S> model_;
  BoxOf box_of_;
};

}  // namespace boxstream::tests
