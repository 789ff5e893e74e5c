// SPDX-License-Identifier: MIT
// Saving a world in mid-run and going on from there. What users can save of a Bullet world is what its bodies say;
// contacts that lie in algorithms, with the impulses of the step before, are not among it.
#include <functional>
#include <vector>

#include "judge.hpp"

namespace boxstream::worlds_test {
namespace {

const btScalar half = btScalar(0.5);
constexpr int steps = 120;

class Restore : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Restore, testing::ValuesIn(kinds),
                         [](const auto& test) { return test_name(test.param); });

void heap(PlainWorld& world) {
  world.add_ground();
  Random random(19);
  btCollisionShape* const shapes[] = {world.shape<btBoxShape>(btVector3(half, half, half)),
                                      world.shape<btSphereShape>(half)};
  for (int i = 0; i < 60; ++i)
    world.add(1, shapes[i % 2], btVector3(random.real(-2, 2), btScalar(0.6) + btScalar(i) / 6, random.real(-2, 2)));
}

/// All that a body says of its state.
struct Saved {
  btTransform place, interpolated;
  btVector3 velocity, spin, interpolated_velocity, interpolated_spin;
  int activation;
  btScalar idle;

  explicit Saved(const btRigidBody& body)
      : place(body.getWorldTransform()),
        interpolated(body.getInterpolationWorldTransform()),
        velocity(body.getLinearVelocity()),
        spin(body.getAngularVelocity()),
        interpolated_velocity(body.getInterpolationLinearVelocity()),
        interpolated_spin(body.getInterpolationAngularVelocity()),
        activation(body.getActivationState()),
        idle(body.getDeactivationTime()) {}

  void put_into(btRigidBody& body) const {
    body.setWorldTransform(place);
    body.setInterpolationWorldTransform(interpolated);
    body.setLinearVelocity(velocity);
    body.setAngularVelocity(spin);
    body.setInterpolationLinearVelocity(interpolated_velocity);
    body.setInterpolationAngularVelocity(interpolated_spin);
    body.updateInertiaTensor();
    body.forceActivationState(activation);
    body.setDeactivationTime(idle);
  }
};

std::vector<Saved> save(const PlainWorld& world) {
  std::vector<Saved> saved;
  for (const auto& body : world.bodies) saved.emplace_back(*body);
  return saved;
}

void restore(PlainWorld& world, const std::vector<Saved>& saved) {
  for (std::size_t i = 0; i < saved.size(); ++i) saved[i].put_into(*world.bodies[i]);
}

void drop_contacts(PlainWorld& world) {
  for (const auto& body : world.bodies)
    world.broadphase->getOverlappingPairCache()->cleanProxyFromPairs(body->getBroadphaseProxy(), &world.dispatcher);
}

std::vector<std::uint64_t> run(PlainWorld& world) {
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < steps; ++i) {
    world.step();
    hashes.push_back(world.state_hash());
  }
  return hashes;
}

int differing(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

std::vector<bullet_test::UidPair> pairs_now(PlainWorld& world) {
  world.world->performDiscreteCollisionDetection();
  return bullet_test::pairs_of(*world.broadphase);
}

TEST_P(Restore, PairsAreThoseOfTheSavedMoment) {
  PlainWorld world(GetParam());
  heap(world);
  for (int i = 0; i < 80; ++i) world.step();
  const std::vector<Saved> saved = save(world);
  const auto pairs = pairs_now(world);
  const auto overlapping = world.held_pairs();
  ASSERT_GT(pairs.size(), 60u);
  for (int i = 0; i < steps; ++i) world.step();
  ASSERT_NE(world.held_pairs(), overlapping);
  restore(world, saved);
  const auto pairs_again = pairs_now(world);
  judge("saved and restored", "pairs of overlapping boxes: the same == 1", GetParam(),
        world.held_pairs() == overlapping, world.held_pairs() == overlapping);
  judge("saved and restored", "list of pairs: the same, in the same order == 1", GetParam(), pairs_again == pairs,
        pairs_again == pairs, Asked::of_boxstream);
}

TEST_P(Restore, GoingOn) {
  for (const bool keep_contacts : {false, true}) {
    PlainWorld world(GetParam());
    heap(world);
    for (int i = 0; i < 80; ++i) world.step();
    const std::vector<Saved> saved = save(world);
    if (!keep_contacts) drop_contacts(world);
    const std::vector<std::uint64_t> first = run(world);
    restore(world, saved);
    if (!keep_contacts) drop_contacts(world);
    const int differ = differing(first, run(world));
    if (keep_contacts)
      judge("saved and restored", "steps that differ afterwards == 0", GetParam(), differ, differ == 0);
    else
      judge("saved and restored, contacts dropped at both times", "steps that differ afterwards == 0", GetParam(),
            differ, differ == 0, Asked::of_boxstream);
  }
}

TEST_P(Restore, ASecondRunInTheSameWorld) {
  PlainWorld world(GetParam());
  heap(world);
  const std::vector<std::uint64_t> first = run(world);
  world.clear();
  // A step without bodies lets go of what Bullet keeps between two.
  world.step();
  world.solver.reset();
  world.broadphase->resetPool(&world.dispatcher);
  heap(world);
  const int differ = differing(first, run(world));
  judge("emptied, reset and built anew", "steps that differ from the first run == 0", GetParam(), differ, differ == 0,
        Asked::of_boxstream);
}

}  // namespace
}  // namespace boxstream::worlds_test
