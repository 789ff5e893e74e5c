// SPDX-License-Identifier: MIT
// 1024 Bullet worlds of 100 bodies, stepped together: one search a step finds the pairs of all of them. A world that is
// stepped alone moves in the same way. "many_bullet_worlds dbvt" times the same worlds on btDbvtBroadphase as well.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "batch_broadphase.hpp"

namespace {

constexpr int worlds = 1024, bodies = 100, steps = 15;
constexpr btScalar dt = btScalar(1) / 60;

std::uint32_t state = 1;
btScalar random_multiple(int most) {
  state = state * 1664525 + 1013904223;
  return btScalar((state >> 8) % std::uint32_t(most + 1)) / 64;
}

/// What all worlds may share, for they take turns.
struct Common {
  btDefaultCollisionConfiguration configuration;
  btSequentialImpulseConstraintSolver solver;
  btSphereShape ball{btScalar(0.5)};
  btBoxShape floor{btVector3(10, 1, 10)};
};

/// Balls that fall on a floor.
template <class Broadphase>
class Tray {
 public:
  explicit Tray(Common& common)
      : dispatcher(&common.configuration), world(&dispatcher, &broadphase, &common.solver, &common.configuration) {
    add(common.floor, 0, btVector3(0, -1, 0));
    for (int i = 1; i < bodies; ++i)
      add(common.ball, 1,
          btVector3(random_multiple(512) - 4, btScalar(0.5) + random_multiple(384), random_multiple(512) - 4));
  }
  ~Tray() {
    for (const auto& body : all) world.removeRigidBody(body.get());
  }

  btCollisionDispatcher dispatcher;
  Broadphase broadphase;
  HalfSteppedWorld world;
  std::vector<std::unique_ptr<btRigidBody>> all;

 private:
  void add(btCollisionShape& shape, btScalar mass, const btVector3& place) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    all.push_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    all.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), place));
    all.back()->setInterpolationWorldTransform(all.back()->getWorldTransform());
    world.addRigidBody(all.back().get());
  }
};

template <class Broadphase>
std::vector<std::unique_ptr<Tray<Broadphase>>> make_trays(Common& common, int count) {
  state = 1;
  std::vector<std::unique_ptr<Tray<Broadphase>>> trays;
  for (int i = 0; i < count; ++i) trays.push_back(std::make_unique<Tray<Broadphase>>(common));
  return trays;
}

class Clock {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A world by itself, with a search of its own.
class Alone : public MemberBroadphase {
 public:
  void calculateOverlappingPairs(btDispatcher* dispatcher) override {
    BatchOfWorlds batch;
    batch.add(*this, *dispatcher);
    batch.find_pairs();
  }
};

bool moves_as_alone(const Tray<MemberBroadphase>& together, Common& common) {
  const auto alone = std::move(make_trays<Alone>(common, 1).front());
  for (int step = 0; step < steps; ++step) alone->world.stepSimulation(dt, 0);
  for (int i = 0; i < bodies; ++i)
    if (!(alone->all[i]->getWorldTransform() == together.all[i]->getWorldTransform())) return false;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Common common;
  const auto trays = make_trays<MemberBroadphase>(common, worlds);
  BatchOfWorlds batch;
  for (const auto& tray : trays) batch.add(tray->broadphase, tray->dispatcher);
  double search = 0;
  const Clock whole;
  for (int step = 1; step <= steps; ++step) {
    for (const auto& tray : trays) tray->world.begin_step(dt);
    const Clock clock;
    for (const auto& tray : trays) tray->world.updateAabbs();
    const std::size_t touching = batch.find_pairs();
    search += clock.milliseconds();
    for (const auto& tray : trays) tray->world.end_step(dt);
    if (step % 5 == 0) std::printf("step %d: %zu pairs in %d worlds\n", step, touching, worlds);
  }
  const double in_all = whole.milliseconds();
  std::printf("a world alone moves in the same way: %s\n", moves_as_alone(*trays.front(), common) ? "yes" : "NO");

  if (argc < 2 || std::strcmp(argv[1], "dbvt") != 0) return 0;
  const auto others = make_trays<btDbvtBroadphase>(common, worlds);
  double other_search = 0;
  const Clock other_whole;
  for (int step = 1; step <= steps; ++step) {
    for (const auto& tray : others) tray->world.begin_step(dt);
    const Clock clock;
    for (const auto& tray : others) {
      tray->world.updateAabbs();
      tray->world.computeOverlappingPairs();
    }
    other_search += clock.milliseconds();
    for (const auto& tray : others) tray->world.end_step(dt);
  }
  std::printf("ms a step, batch: %.1f for boxes and pairs, %.1f in all\n", search / steps, in_all / steps);
  std::printf("ms a step, btDbvtBroadphase: %.1f for boxes and pairs, %.1f in all\n", other_search / steps,
              other_whole.milliseconds() / steps);
}
