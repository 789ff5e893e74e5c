// SPDX-License-Identifier: MIT
// Random histories of a World against the plain model, whatever way the updates search.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "model.hpp"
#include "values.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

enum class Kind {
  create,
  create_many,
  destroy,
  destroy_many,
  move,
  move_many,
  move_all,
  move_nowhere,
  bulk_create,
  bulk_destroy,
  bulk_move,
  filter,
  update,
  update_refusing,
  release,
  begin_pairs,
  query,
  stale,
  clear
};

struct Op {
  Kind kind;
  unsigned which;
  unsigned value;
};

std::ostream& operator<<(std::ostream& out, const Op& op) {
  return out << '(' << int(op.kind) << ' ' << op.which << ' ' << op.value << ')';
}

/// Plays operations on a World and on the model, and compares all that can be seen after each.
template <class S, class World>
class Player {
 public:
  Player(World& world, bool sticky, unsigned grid) : world_(world), model_(sticky), grid_(grid) {}

  void play(const Op& op) {
    const auto living = model_.alive();
    const auto some = [&](unsigned i) { return living[(op.which + i * 7919u) % living.size()]; };
    switch (op.kind) {
      case Kind::create:
        create(op.value);
        break;
      case Kind::create_many:
        for (unsigned i = 0; i < 20 + op.which % 100; ++i) create(op.value + i);
        break;
      case Kind::destroy:
        if (!living.empty()) destroy(some(0));
        break;
      case Kind::destroy_many:
        for (unsigned i = 0; i < 60; ++i)
          if (!model_.alive().empty()) destroy(model_.alive()[(op.which + i * 31) % model_.alive().size()]);
        break;
      case Kind::move:
        if (!living.empty()) move(some(0), op.value);
        break;
      case Kind::move_many:
        for (unsigned i = 0; i < 30 && !living.empty(); ++i) move(some(i), op.value + i);
        break;
      case Kind::move_all:
        for (const Birth b : living) move(b, op.value + static_cast<unsigned>(b));
        break;
      case Kind::move_nowhere:
        for (const Birth b : living) EXPECT_TRUE(world_.move(id(b), model_.proxies()[b].box));
        break;
      case Kind::bulk_create:
        bulk_create(op.which % 150, op.value);
        break;
      case Kind::bulk_destroy:
        bulk_destroy(op.which, op.value);
        break;
      case Kind::bulk_move:
        bulk_move(op.which, op.value);
        break;
      case Kind::filter:
        if (!living.empty()) filter(some(0), op.value);
        break;
      case Kind::update:
        update(0);
        break;
      case Kind::update_refusing:
        update(2 + op.value % 3);
        break;
      case Kind::release:
        release(op.which, op.value);
        break;
      case Kind::begin_pairs:
        if (!living.empty()) begin_pairs(some(0), 1 + op.value % 3);
        break;
      case Kind::query:
        query(op.value);
        break;
      case Kind::stale:
        stale(op.which);
        break;
      case Kind::clear:
        clear();
        break;
    }
    compare_state();
  }

 private:
  ProxyId id(Birth b) const { return model_.proxies()[b].id; }
  Births births(ProxyPair p) const { return {model_.birth(p.a), model_.birth(p.b)}; }

  void create(unsigned value) {
    const auto box = box_from<S>(value, grid_);
    const Filter filter = filter_from(value);
    const ProxyId made = world_.create(box, filter, value);
    ASSERT_TRUE(made);
    model_.create(made, box, filter, value);
  }
  static Filter filter_from(unsigned value) { return value % 7 == 0 ? Filter{value % 3, ~0u} : Filter{}; }

  /// Filters and user words may be left out.
  void bulk_create(unsigned count, unsigned value) {
    std::vector<BasicAabb<S>> boxes;
    std::vector<Filter> filters;
    std::vector<std::uint64_t> users;
    for (unsigned i = 0; i < count; ++i) {
      boxes.push_back(box_from<S>(value + i, grid_));
      if (value % 2 == 0) filters.push_back(filter_from(value + i));
      if (value % 3 == 0) users.push_back(value + i);
    }
    std::vector<ProxyId> made(count);
    world_.create(Span<const BasicAabb<S>>(boxes), Span<const Filter>(filters), Span<ProxyId>(made),
                  Span<const std::uint64_t>(users));
    for (unsigned i = 0; i < count; ++i) {
      ASSERT_TRUE(made[i]);
      model_.create(made[i], boxes[i], filters.empty() ? Filter{} : filters[i], users.empty() ? 0 : users[i]);
    }
  }

  /// Some of the living and some of the dead, repetitions included, mostly in order of creation.
  std::vector<Birth> mixture(unsigned which, unsigned value) const {
    std::vector<Birth> chosen;
    const auto& all = model_.proxies();
    if (all.empty()) return chosen;
    const std::size_t stride = 1 + which % 5;
    for (std::size_t i = which % stride; i < all.size(); i += stride) chosen.push_back(i);
    if (value % 2 == 0) std::reverse(chosen.begin(), chosen.end());
    for (unsigned i = 0; i < value % 4; ++i) chosen.push_back((which + 31 * i) % all.size());
    return chosen;
  }

  void bulk_destroy(unsigned which, unsigned value) {
    auto chosen = mixture(which, value);
    chosen.resize(std::min<std::size_t>(chosen.size(), value % 64));
    std::vector<ProxyId> ids{ProxyId{}};
    std::size_t live = 0;
    for (const Birth b : chosen) {
      ids.push_back(id(b));
      live += model_.proxies()[b].alive;
      model_.destroy(b);
    }
    EXPECT_EQ(world_.destroy(Span<const ProxyId>(ids)), live);
  }

  void bulk_move(unsigned which, unsigned value) {
    std::vector<ProxyId> ids{ProxyId{}};
    std::vector<BasicAabb<S>> boxes{box_from<S>(value, grid_)};
    std::size_t live = 0;
    for (const Birth b : mixture(which, value)) {
      auto& proxy = model_.proxies()[b];
      const bool goes = (value / 4 + b) % 3 != 0;
      const auto box = goes ? box_from<S>(value + static_cast<unsigned>(b), grid_) : proxy.box;
      ids.push_back(proxy.id);
      boxes.push_back(box);
      if (proxy.alive) {
        ++live;
        note_move(proxy, box);
      }
    }
    EXPECT_EQ(world_.move(Span<const ProxyId>(ids), Span<const BasicAabb<S>>(boxes)), live);
  }

  void destroy(Birth b) {
    ASSERT_TRUE(world_.destroy(id(b)));
    model_.destroy(b);
    EXPECT_FALSE(world_.contains(id(b)));
    EXPECT_FALSE(world_.destroy(id(b)));
  }
  void move(Birth b, unsigned value) {
    const auto box = box_from<S>(value, grid_);
    auto& proxy = model_.proxies()[b];
    ASSERT_TRUE(world_.move(proxy.id, box));
    note_move(proxy, box);
  }
  static void note_move(typename Model<S>::Proxy& proxy, const BasicAabb<S>& box) {
    const bool same = is_valid(box) ? proxy.box == box : !is_valid(proxy.box);
    proxy.box = box;
    proxy.moved |= !same;
  }
  void filter(Birth b, unsigned value) {
    const Filter f{value % 4, value / 4 % 4};
    ASSERT_TRUE(world_.set_filter(id(b), f));
    model_.proxies()[b].filter = f;
  }

  /// `modulus` 0: without a callback. Else the callback refuses one pair in so many.
  void update(unsigned modulus) {
    const auto living = model_.alive();
    std::uint64_t invalid = 0;
    std::uint64_t moved = 0;
    for (const Birth b : living) {
      invalid += !is_valid(model_.proxies()[b].box);
      moved += model_.proxies()[b].moved;
    }
    std::vector<Births> asked;
    const auto verdict = [&](const Births& p) { return modulus == 0 || (p.first * 5 + p.second * 3) % modulus != 0; };
    const auto accept = [&](ProxyId a, ProxyId b) {
      asked.push_back(births({a, b}));
      return verdict(asked.back());
    };
    const WorldStats stats = modulus == 0 ? world_.update() : world_.update(accept);

    std::vector<Births> to_be_asked;
    const auto changes = model_.update([&](const Births& p) {
      if (modulus != 0) to_be_asked.push_back(p);
      return verdict(p);
    });
    EXPECT_EQ(asked, to_be_asked);
    EXPECT_EQ(all_births(world_.begun()), changes.begun);
    EXPECT_EQ(all_births(world_.ended()), changes.ended);
    EXPECT_EQ(stats.proxies, living.size());
    EXPECT_EQ(stats.invalid, invalid);
    EXPECT_EQ(stats.moved, moved);
    EXPECT_EQ(stats.pairs, model_.held().size());
    EXPECT_EQ(stats.begun, changes.begun.size());
    EXPECT_EQ(stats.ended, changes.ended.size());
  }

  void release(unsigned which, unsigned value) {
    const auto& held = model_.held();
    if (held.empty()) return;
    auto pair = held.begin();
    std::advance(pair, static_cast<std::ptrdiff_t>(which % held.size()));
    ProxyId a = id(pair->first);
    ProxyId b = id(pair->second);
    if (value % 2 == 1) std::swap(a, b);
    const bool alive = model_.proxies()[pair->first].alive && model_.proxies()[pair->second].alive;
    EXPECT_EQ(world_.release(a, b), alive);
    if (!alive) return;
    EXPECT_FALSE(world_.release(a, b));
    model_.held().erase(*pair);
  }

  void begin_pairs(Birth b, unsigned modulus) {
    std::vector<Births> asked;
    std::vector<Births> begun;
    world_.begin_pairs_of(
        id(b),
        [&](ProxyId x, ProxyId y) {
          asked.push_back(births({x, y}));
          return modulus == 1 || (asked.back().first + asked.back().second) % modulus != 0;
        },
        [&](ProxyPair p) { begun.push_back(births(p)); });
    std::vector<Births> to_be_asked;
    std::vector<Births> to_begin;
    for (const Birth other : model_.alive()) {
      const Births pair = std::minmax(b, other);
      if (other == b || !model_.can_begin(pair.first, pair.second)) continue;
      to_be_asked.push_back(pair);
      if (modulus == 1 || (pair.first + pair.second) % modulus != 0) to_begin.push_back(pair);
    }
    for (const Births& pair : to_begin) model_.held().insert(pair);
    EXPECT_EQ(asked, to_be_asked);
    EXPECT_EQ(begun, to_begin);
  }

  void query(unsigned value) {
    const auto box = box_from<S>(value, grid_);
    std::vector<Birth> in_box;
    world_.query_box(box, [&](ProxyId p) {
      in_box.push_back(model_.birth(p));
      return true;
    });
    std::sort(in_box.begin(), in_box.end());
    EXPECT_EQ(in_box, model_.in_box(box));

    const auto ray = ray_from<S>(value);
    std::map<Birth, S> on_ray;
    world_.query_ray(ray, [&](ProxyId p, S enter, S length) {
      EXPECT_TRUE(on_ray.emplace(model_.birth(p), enter).second) << "met twice";
      return length;
    });
    EXPECT_EQ(on_ray, model_.on_ray(ray));

    const S point[3] = {box.min[0], box.max[1], box.min[2]};
    std::vector<ProxyId> nearest(value % 50);
    nearest.resize(world_.query_nearest(point, Span<ProxyId>(nearest)));
    std::vector<Birth> near;
    for (const ProxyId p : nearest) near.push_back(model_.birth(p));
    EXPECT_EQ(near, model_.nearest(point, value % 50));

    BasicAabb<S> all = detail::ProxyTable<S>::inert_box();
    for (const Birth b : model_.alive())
      if (is_valid(model_.proxies()[b].box)) all = merged(all, model_.proxies()[b].box);
    EXPECT_TRUE(world_.bounds() == all);
  }

  void stale(unsigned which) {
    for (const auto& proxy : model_.proxies()) {
      if (proxy.alive) continue;
      EXPECT_FALSE(world_.contains(proxy.id));
      EXPECT_FALSE(world_.move(proxy.id, proxy.box));
      EXPECT_FALSE(world_.set_filter(proxy.id, {}));
      EXPECT_FALSE(world_.set_user(proxy.id, 1));
      if (which % 2 == 0)
        world_.begin_pairs_of(
            proxy.id, [](ProxyId, ProxyId) { return true; }, [](ProxyPair) { FAIL(); });
    }
    EXPECT_FALSE(world_.contains({}));
    EXPECT_FALSE(world_.destroy(ProxyId{}));
  }

  void clear() {
    world_.clear();
    model_.clear();
    EXPECT_TRUE(world_.begun().empty());
    EXPECT_TRUE(world_.ended().empty());
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
      if (is_valid(proxy.box))
        EXPECT_TRUE(world_.box(proxy.id) == proxy.box);
      else
        EXPECT_FALSE(is_valid(world_.box(proxy.id)));
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
  unsigned grid_;
};

rc::Gen<std::vector<Op>> histories() {
  const auto kind = rc::gen::weightedElement<Kind>({{4, Kind::create},
                                                    {4, Kind::create_many},
                                                    {4, Kind::destroy},
                                                    {2, Kind::destroy_many},
                                                    {6, Kind::move},
                                                    {4, Kind::move_many},
                                                    {3, Kind::move_all},
                                                    {1, Kind::move_nowhere},
                                                    {4, Kind::bulk_create},
                                                    {3, Kind::bulk_destroy},
                                                    {6, Kind::bulk_move},
                                                    {6, Kind::filter},
                                                    {10, Kind::update},
                                                    {8, Kind::update_refusing},
                                                    {5, Kind::release},
                                                    {5, Kind::begin_pairs},
                                                    {5, Kind::query},
                                                    {1, Kind::stale},
                                                    {1, Kind::clear}});
  return rc::gen::container<std::vector<Op>>(
      rc::gen::build<Op>(rc::gen::set(&Op::kind, kind), rc::gen::set(&Op::which, rc::gen::inRange(0u, 100000u)),
                         rc::gen::set(&Op::value, rc::gen::inRange(0u, 100000u))));
}

/// D2 rows 1-5, 9, 11, 16-18, 21-24, 28, 29.
template <class S>
bool histories_agree(detail::SearchMode mode, bool sticky, unsigned grid) {
  return rc::check([=] {
    const auto ops = *histories();
    WorldOptions options;
    options.sticky_filters = sticky;
    detail::WorldCore<S> world(options, mode);
    Player<S, detail::WorldCore<S>> player(world, sticky, grid);
    for (const Op& op : ops) {
      player.play(op);
      RC_ASSERT(!::testing::Test::HasFailure());
    }
  });
}

using Case = std::tuple<detail::SearchMode, bool, unsigned>;

class OpStream : public ::testing::TestWithParam<Case> {};

TEST_P(OpStream, FloatWorldAgreesWithTheModel) {
  const auto [mode, sticky, grid] = GetParam();
  EXPECT_TRUE(histories_agree<float>(mode, sticky, grid));
}

TEST_P(OpStream, DoubleWorldAgreesWithTheModel) {
  const auto [mode, sticky, grid] = GetParam();
  EXPECT_TRUE(histories_agree<double>(mode, sticky, grid));
}

std::string case_name(const ::testing::TestParamInfo<Case>& test) {
  const auto [mode, sticky, grid] = test.param;
  const char* const modes[] = {"none", "probe", "all", "fences", "cheapest"};
  return std::string(modes[int(mode)]) + (sticky ? "Sticky" : "Live") + "Grid" + std::to_string(grid);
}

INSTANTIATE_TEST_SUITE_P(World, OpStream,
                         ::testing::Combine(::testing::Values(detail::SearchMode::probe, detail::SearchMode::all,
                                                              detail::SearchMode::fences, detail::SearchMode::cheapest),
                                            ::testing::Bool(), ::testing::Values(8u, 40u)),
                         case_name);

}  // namespace boxstream::tests
