// SPDX-License-Identifier: MIT
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include <algorithm>
#include <deque>
#include <memory>

#include <boxstream/fcl.hpp>

#include "cliffs/keeper.hpp"
#include "peers/fcl_peer.hpp"

namespace boxstream::bench {

namespace {

using Manager = ::fcl::BroadPhaseCollisionManager<double>;
using Object = ::fcl::CollisionObject<double>;

double distance_of(const ::fcl::AABB<double>& a, const ::fcl::AABB<double>& b) {
  double squares = 0;
  for (int d = 0; d < 3; ++d) {
    const double gap = std::max({0.0, a.min_[d] - b.max_[d], b.min_[d] - a.max_[d]});
    squares += gap * gap;
  }
  return std::sqrt(squares);
}

bool count_pair(Object*, Object*, void* count) {
  ++*static_cast<std::uint64_t*>(count);
  return false;
}

bool least_distance(Object* a, Object* b, void* least, double& limit) {
  double& so_far = *static_cast<double*>(least);
  so_far = std::min(so_far, distance_of(a->getAABB(), b->getAABB()));
  limit = so_far;
  return so_far <= 0;
}

/// A manager of FCL or ours.
class ManagerKeeper final : public Keeper {
 public:
  using Make = std::unique_ptr<Manager> (*)();

  explicit ManagerKeeper(Make make) : manager(make()), make_(make) {}

  void fill(Span<const Aabb> boxes) override {
    const auto ball = std::make_shared<::fcl::Sphere<double>>(1.0);
    std::vector<Object*> pointers;
    for (const Aabb& box : boxes) {
      objects.emplace_back(ball, static_cast<std::uint32_t>(objects.size()), box);
      pointers.push_back(&objects.back());
    }
    manager->registerObjects(pointers);
    manager->setup();
  }
  void remove(std::uint32_t i) override { manager->unregisterObject(&objects[i]); }
  void add(std::uint32_t i, const Aabb& box) override {
    objects[i].set(box);
    manager->registerObject(&objects[i]);
  }
  void come(const Aabb& box) override {
    if (newcomer_ == nullptr)
      newcomer_ = std::make_unique<FclObject<double>>(std::make_shared<::fcl::Sphere<double>>(1.0),
                                                      static_cast<std::uint32_t>(objects.size()), box);
    newcomer_->set(box);
    manager->registerObject(newcomer_.get());
  }
  void leave() override { manager->unregisterObject(newcomer_.get()); }
  void move(Span<const std::uint32_t> which, Span<const Aabb> boxes) override {
    for (const std::uint32_t i : which) objects[i].set(boxes[i]);
    if (which.size() == boxes.size()) {
      manager->update();
      return;
    }
    moved_.clear();
    for (const std::uint32_t i : which) moved_.push_back(&objects[i]);
    manager->update(moved_);
  }
  void update() override { manager->collide(&count, count_pair); }
  PairSummary pairs(Span<const Aabb>) override {
    PairSummary summary;
    manager->collide(&summary, [](Object* a, Object* b, void* data) {
      static_cast<PairSummary*>(data)->add(fcl_index(a), fcl_index(b));
      return false;
    });
    return summary;
  }

  /// A manager of the same kind that knows every fourth object, where it is in frame 1.
  Manager* quarter(const CliffScene& scene) {
    if (quarter_ != nullptr) return quarter_->manager.get();
    quarter_ = std::make_unique<ManagerKeeper>(make_);
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < scene.size(); i += 4) boxes.push_back(scene.at(1, i));
    quarter_->fill(boxes);
    return quarter_->manager.get();
  }

  std::unique_ptr<Manager> manager;
  std::deque<FclObject<double>> objects;
  std::uint64_t count = 0;

 private:
  Make make_;
  std::vector<Object*> moved_;
  std::unique_ptr<FclObject<double>> newcomer_;
  std::unique_ptr<ManagerKeeper> quarter_;
};

template <class Kind>
std::unique_ptr<Keeper> make_keeper() {
  return std::make_unique<ManagerKeeper>([]() -> std::unique_ptr<Manager> { return std::make_unique<Kind>(); });
}
constexpr auto make_ours = make_keeper<boxstream::fcl::CollisionManager<double>>;
constexpr auto make_tree = make_keeper<::fcl::DynamicAABBTreeCollisionManager<double>>;

/// One that is not registered.
Object& asker(const Aabb& box, float away) {
  static FclObject<double> object(std::make_shared<::fcl::Sphere<double>>(1.0), 0, Aabb{});
  Aabb moved = box;
  for (int d = 0; d < 3; ++d) {
    moved.min[d] += away;
    moved.max[d] += away;
  }
  object.set(moved);
  return object;
}

/// As an answer to compare. One object alone has no distance.
std::uint64_t rounded(double least, double unit) {
  return least < 1e9 ? static_cast<std::uint64_t>(least / unit) : ~std::uint64_t{0};
}

std::uint64_t collide_one(Keeper& keeper, const CliffScene& scene) {
  std::uint64_t found = 0;
  static_cast<ManagerKeeper&>(keeper).manager->collide(&asker(scene.at(1, ++keeper.turn * 7 % scene.size()), 0.1f),
                                                       &found, count_pair);
  return found;
}

std::uint64_t distance_one(Keeper& keeper, const CliffScene& scene) {
  double least = 1e300;
  static_cast<ManagerKeeper&>(keeper).manager->distance(&asker(scene.at(1, ++keeper.turn * 7 % scene.size()), 1.5f),
                                                        &least, least_distance);
  return rounded(least, 1e-6);
}

std::uint64_t distance_far(Keeper& keeper, const CliffScene& scene) {
  double least = 1e300;
  static_cast<ManagerKeeper&>(keeper).manager->distance(&asker(scene.at(0, ++keeper.turn * 7 % scene.size()), -1000.f),
                                                        &least, least_distance);
  return rounded(least, 1e-3);
}

std::uint64_t distance_self(Keeper& keeper, const CliffScene&) {
  double least = 1e300;
  static_cast<ManagerKeeper&>(keeper).manager->distance(&least, least_distance);
  return rounded(least, 1e-6);
}

std::uint64_t collide_two(Keeper& keeper, const CliffScene& scene) {
  auto& mine = static_cast<ManagerKeeper&>(keeper);
  std::uint64_t found = 0;
  mine.manager->collide(mine.quarter(scene), &found, count_pair);
  return found;
}

std::uint64_t distance_two(Keeper& keeper, const CliffScene& scene) {
  auto& mine = static_cast<ManagerKeeper&>(keeper);
  double least = 1e300;
  mine.manager->distance(mine.quarter(scene), &least, least_distance);
  return rounded(least, 1e-6);
}

std::uint64_t out_in_ask(Keeper& keeper, const CliffScene& scene) {
  const auto i = static_cast<std::uint32_t>(++keeper.turn * 7 % scene.size());
  keeper.remove(i);
  keeper.add(i, scene.at(0, i));
  return collide_one(keeper, scene);
}

}  // namespace

std::vector<CliffCall> fcl_calls() {
  std::vector<CliffCall> calls = frame_calls("FCL", make_ours, make_tree);
  const auto add = [&](const char* name, const char* description, auto run) {
    calls.push_back({"FCL", name, description, make_ours, make_tree, run});
  };
  add("collide one", "one object with all", collide_one);
  add("distance inside", "the least distance of one object in the crowd", distance_one);
  add("distance outside", "the same from far away", distance_far);
  add("distance of all", "the least distance of two of the crowd", distance_self);
  add("collide two", "all with those of another manager, a quarter as many", collide_two);
  add("distance two", "the least distance of two managers, one with a quarter as many", distance_two);
  add("out, in, ask", "one is taken out and put in, then another is asked about", out_in_ask);
  return calls;
}

}  // namespace boxstream::bench
