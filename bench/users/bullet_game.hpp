// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <btBulletDynamicsCommon.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "formats/scene_model/random.hpp"
#include "users/broadphase_choice.hpp"
#include "users/step_contest.hpp"

namespace boxstream::bench {

/// A Bullet world as a program makes it, with what it takes to make one, and all that is in it.
class Game final : public SteppedWorld {
 public:
  struct Setup {
    std::string broadphase;
    bool borrows_cache = false;  ///< a btHashedOverlappingPairCache of the program's own
    double reach = 500;          ///< for sweep and prune
    std::size_t most = 1000;     ///< objects, likewise
    std::uint64_t seed = 1;
  };
  explicit Game(const Setup& setup);
  ~Game() override;
  Game(const Game&) = delete;
  Game& operator=(const Game&) = delete;

  // For building it. What is added lives as long as the Game.
  btDiscreteDynamicsWorld& world();
  btOverlappingPairCache& pair_cache();
  double random(double low, double high);
  btCollisionShape* box(double x, double y, double z);
  btCollisionShape* sphere(double radius);
  btCollisionShape* keep(std::unique_ptr<btCollisionShape> shape);
  template <class T>
  T* own(std::unique_ptr<T> thing) {
    things_.push_back(std::shared_ptr<T>(std::move(thing)));
    return static_cast<T*>(things_.back().get());
  }
  /// Of mass 0: static.
  btRigidBody* add_body(btCollisionShape* shape, double mass, const btVector3& at);
  btRigidBody* add_body(btCollisionShape* shape, double mass, const btVector3& at, int group, int mask);
  btPairCachingGhostObject* add_ghost(btCollisionShape* shape, const btVector3& at);
  void add_character(double radius, double height, const btVector3& at, const btVector3& walk);
  const std::vector<btRigidBody*>& bodies() const { return bodies_; }
  void keep_awake();
  void put_to_sleep();

  /// Called before each step with its number; not timed.
  void before_step(std::function<void(int)> call) { before_step_ = std::move(call); }
  /// Called after each step, and timed for itself.
  void cast_rays(std::function<void()> call) { cast_rays_ = std::move(call); }

  /// Where all bodies are and how they move, for another Game of the same build.
  struct State {
    std::vector<btTransform> at;
    std::vector<btVector3> velocity, spin;
  };
  State state() const;
  void restore(const State& state);

  void step(bool check) override;
  /// The broad-phase's share of a step in which nothing moves.
  void detect_only();
  std::size_t objects() const override;
  bool casts_rays() const override { return bool(cast_rays_); }
  std::string broadphase() const override { return name_; }

 private:
  class TimedWorld;
  class Stopwatch;

  void check_pairs();

  std::string name_;
  scenes::Random random_;
  std::unique_ptr<btOverlappingPairCache> borrowed_;
  std::unique_ptr<btDefaultCollisionConfiguration> configuration_;
  std::unique_ptr<btCollisionDispatcher> dispatcher_;
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::unique_ptr<btSequentialImpulseConstraintSolver> solver_;
  btGhostPairCallback ghost_callback_;
  std::vector<std::shared_ptr<void>> things_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::vector<std::unique_ptr<btActionInterface>> actions_;
  std::vector<btRigidBody*> bodies_;
  std::unique_ptr<TimedWorld> world_;
  std::function<void(int)> before_step_;
  std::function<void()> cast_rays_;
  int steps_ = 0;
};

}  // namespace boxstream::bench
