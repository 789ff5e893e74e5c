// SPDX-License-Identifier: MIT
#include <algorithm>
#include <random>
#include <tuple>

#include <boxstream/world.hpp>

#include "core/fast_oracle.hpp"
#include "load.hpp"

namespace boxstream::soak {
namespace {

using tests::Pairs;

/// Proxies are identified by their order of creation in this history, which is also the order of pairs.
class WorldLoad final : public Load {
 public:
  std::uint64_t round(std::uint64_t seed) override {
    random_.seed(seed);
    world_.clear();
    ids_.clear();
    boxes_.clear();
    alive_.clear();
    Pairs held;
    std::uint64_t compared = 0;
    create(1000 + pick(4000));
    for (int frame = 0; frame < 12; ++frame) {
      change();
      world_.update();
      world_.validate();
      const Pairs truth = tests::sweep(boxes_now());
      require(events(world_.begun()), without(truth, held), "begun");
      require(events(world_.ended()), without(held, truth), "ended");
      compared += 2 + ask();
      held = truth;
    }
    return compared;
  }

 private:
  unsigned pick(unsigned n) { return static_cast<unsigned>(random_() % n); }
  float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

  /// Sizes over three decades; one in two hundred is no box, or has no end.
  Aabb any_box() {
    const float size = 0.02f * std::pow(1000.0f, real(0, 1));
    Aabb box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = real(-20, 20);
      box.max[d] = box.min[d] + size * real(0.5f, 1.5f);
    }
    const unsigned kind = pick(400);
    if (kind == 0) box.min[pick(3)] = std::numeric_limits<float>::quiet_NaN();
    if (kind == 1) box.max[pick(3)] = std::numeric_limits<float>::infinity();
    return box;
  }

  void create(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      boxes_.push_back(any_box());
      alive_.push_back(true);
      ids_.push_back(world_.create(boxes_.back(), {}, ids_.size()));
    }
  }

  void change() {
    const unsigned few = pick(3) == 0 ? 1 : 20;  // all of them now and then
    const bool jump = pick(4) == 0;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (!alive_[i] || pick(few) != 0) continue;
      if (jump) {
        boxes_[i] = any_box();
      } else {
        const float by = real(-0.05f, 0.05f);
        const int d = static_cast<int>(pick(3));
        boxes_[i].min[d] += by;
        boxes_[i].max[d] += by;
      }
      world_.move(ids_[i], boxes_[i]);
    }
    for (unsigned i = pick(60); i > 0; --i) {
      const std::size_t at = pick(static_cast<unsigned>(ids_.size()));
      if (world_.destroy(ids_[at]) != alive_[at]) throw Wrong("world: destroy disagrees about which proxies live");
      alive_[at] = false;
    }
    create(pick(60));
  }

  tests::Boxes<float> boxes_now() const {
    tests::Boxes<float> now = boxes_;
    for (std::size_t i = 0; i < now.size(); ++i)
      if (!alive_[i]) now[i].min[0] = std::numeric_limits<float>::quiet_NaN();
    return now;
  }

  /// Stale ids in events are those of proxies that died in this frame: their births are looked up like all others'.
  Pairs events(Span<const ProxyPair> pairs) const {
    Pairs births;
    for (const ProxyPair& pair : pairs) births.push_back({birth(pair.a), birth(pair.b)});
    std::sort(births.begin(), births.end());
    return births;
  }

  std::uint32_t birth(ProxyId id) const {
    if (world_.contains(id)) return static_cast<std::uint32_t>(world_.user(id));
    for (std::size_t i = ids_.size(); i-- > 0;)
      if (ids_[i] == id) return static_cast<std::uint32_t>(i);
    throw Wrong("world: an event names a proxy that never was");
  }

  std::uint64_t ask() {
    const Aabb where = any_box();
    std::vector<std::uint32_t> found, expected;
    world_.query_box(where, [&](ProxyId id) {
      found.push_back(birth(id));
      return true;
    });
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
      if (alive_[i] && tests::makes_sense(where) && tests::makes_sense(boxes_[i]) && tests::touch(where, boxes_[i]))
        expected.push_back(i);
    std::sort(found.begin(), found.end());
    if (found != expected)
      throw Wrong("world: a query of a box finds " + std::to_string(found.size()) + " proxies, there are " +
                  std::to_string(expected.size()));
    return 1;
  }

  static Pairs without(const Pairs& all, const Pairs& these) {
    Pairs rest;
    std::set_difference(all.begin(), all.end(), these.begin(), these.end(), std::back_inserter(rest));
    return rest;
  }

  void require(const Pairs& found, const Pairs& truth, const std::string& what) const {
    const std::string difference = tests::first_difference(found, truth, boxes_, boxes_);
    if (!difference.empty()) throw Wrong("world, pairs that " + what + ": " + difference);
  }

  std::mt19937_64 random_;
  World world_;
  std::vector<ProxyId> ids_;
  tests::Boxes<float> boxes_;
  std::vector<bool> alive_;
};

}  // namespace

std::unique_ptr<Load> world_load() {
  return std::make_unique<WorldLoad>();
}

}  // namespace boxstream::soak
