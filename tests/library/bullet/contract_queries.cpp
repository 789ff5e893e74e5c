// SPDX-License-Identifier: MIT
// Section 6 of the contract: rayTest and aabbTest.
#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

constexpr btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();

bool contains(const std::vector<const btBroadphaseProxy*>& found, const btBroadphaseProxy* proxy) {
  return std::find(found.begin(), found.end(), proxy) != found.end();
}

/// The clients that a query reports, because AxisSweep hands out proxies of its own.
bool sees(Rig& rig, const btBroadphaseProxy* proxy, btScalar x) {
  Found in_box;
  const Box at = cube(x, 0, 0, btScalar(0.1));
  rig.broadphase->aabbTest(at.lo, at.hi, in_box);
  FoundOnRay on_ray(btVector3(x, -9, 0), btVector3(x, 9, 0));
  rig.broadphase->rayTest(btVector3(x, -9, 0), btVector3(x, 9, 0), on_ray);
  const auto has = [&](const std::vector<const void*>& clients) {
    return std::binary_search(clients.begin(), clients.end(), proxy->m_clientObject);
  };
  EXPECT_TRUE(!has(in_box.clients()) || has(on_ray.clients())) << "the ray missed what the box found";
  return has(in_box.clients());
}

TEST(BulletContract, Q1_QueriesSeeEveryEarlierCall) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    std::vector<btBroadphaseProxy*> others;
    for (int i = 0; i < 50; ++i) others.push_back(rig.create(cube(btScalar(-3 * i - 20), 0, 0)));
    btBroadphaseProxy* proxy = rig.create(cube(0, 0, 0));
    EXPECT_TRUE(sees(rig, proxy, 0)) << kind;
    for (int i = 1; i < 20; ++i) {
      rig.move(proxy, cube(btScalar(3 * i), 0, 0));
      EXPECT_TRUE(sees(rig, proxy, btScalar(3 * i))) << kind;
      EXPECT_FALSE(sees(rig, proxy, btScalar(3 * i - 3))) << kind;
      if (i % 7 == 0) rig.calculate();
    }
    btCollisionObject* client = static_cast<btCollisionObject*>(proxy->m_clientObject);
    rig.destroy(proxy);
    btBroadphaseProxy stand_in(btVector3(0, 0, 0), btVector3(0, 0, 0), client, 1, 1);
    EXPECT_FALSE(sees(rig, &stand_in, 57)) << kind;
    proxy = rig.create_for(client, cube(0, 0, 0));
    EXPECT_TRUE(sees(rig, proxy, 0)) << kind;
  }
}

TEST(BulletContract, Q2_NoFilteringAndEachProxyOnce) {
  Rig rig;
  FunctionFilter refuse([](auto, auto) { return false; });
  rig.cache().setOverlapFilterCallback(&refuse);
  Random random(2);
  std::vector<const btBroadphaseProxy*> all;
  for (int i = 0; i < 500; ++i) {
    const btVector3 p = random.vector(-3, 3);
    all.push_back(rig.create(cube(p.x(), p.y(), p.z(), random.real(0, 2)), i % 3, i % 5));
  }
  for (int round = 0; round < 3; ++round) {  // before, between and after batches
    const std::vector<const btBroadphaseProxy*> found = rig.in_box(cube(0, 0, 0, 10));
    EXPECT_EQ(found, sorted(all));
    std::vector<const btBroadphaseProxy*> hit = rig.on_ray(btVector3(-9, 1, 1), btVector3(9, -1, -1));
    EXPECT_EQ(std::adjacent_find(hit.begin(), hit.end()), hit.end());
    rig.calculate();
  }
  EXPECT_EQ(rig.pair_count(), 0);
  EXPECT_TRUE(contains(rig.in_box({all[7]->m_aabbMin, all[7]->m_aabbMax}), all[7]));  // the asker itself
  rig.cache().setOverlapFilterCallback(nullptr);
}

TEST(BulletContract, Q3_BoxQueriesAreExact) {
  auto* oracle = new Oracle(make_broadphase(Kind::subject));
  Rig rig;
  rig.broadphase.reset(oracle);
  Random random(3);
  std::vector<btBroadphaseProxy*> all;
  for (int i = 0; i < 700; ++i) {
    const btVector3 p = random.vector(-10, 10);
    all.push_back(rig.create(cube(p.x(), p.y(), p.z(), random.real(0, 1))));
  }
  for (int round = 0; round < 200; ++round) {
    for (int i = 0; i < 5; ++i) {
      const btVector3 p = random.vector(-10, 10);
      rig.move(all[static_cast<std::size_t>(random.below(700))], cube(p.x(), p.y(), p.z(), random.real(0, 1)));
    }
    if (round % 50 == 0) rig.calculate();
    const btVector3 p = random.vector(-11, 11);
    const Box box = cube(p.x(), p.y(), p.z(), random.real(0, 4));
    ASSERT_EQ(rig.in_box(box), sorted(oracle->expected_in_box(box.lo, box.hi))) << "round " << round;
  }
}

TEST(BulletContract, Q3_RaysReportNoDistantBoxes) {
  Rig rig;
  for (int i = 0; i < 1000; ++i)
    rig.create(cube(btScalar(3 * (i % 10)), btScalar(3 * (i / 10 % 10)), btScalar(i / 100 * 3)));
  EXPECT_EQ(rig.on_ray(btVector3(-5, 0, 0), btVector3(50, 0, 0)).size(), 10u);
  EXPECT_EQ(rig.on_ray(btVector3(-5, btScalar(1.5), 0), btVector3(50, btScalar(1.5), 0)).size(), 0u);
  EXPECT_EQ(rig.on_ray(btVector3(-5, 0, 0), btVector3(10, 0, 0)).size(), 4u);  // its length counts
}

TEST(BulletContract, Q4_AnswerOfTheCallbackIsIgnored) {
  for (const Kind kind : all_kinds) {
    Rig rig(kind);
    for (int i = 0; i < 40; ++i) rig.create(cube(btScalar(i), 0, 0));
    Found found;
    found.answer = false;
    const Box everything = cube(20, 0, 0, 50);
    rig.broadphase->aabbTest(everything.lo, everything.hi, found);
    EXPECT_EQ(found.proxies.size(), 40u) << kind;
    FoundOnRay hit(btVector3(-5, 0, 0), btVector3(90, 0, 0));
    hit.answer = false;
    rig.broadphase->rayTest(btVector3(-5, 0, 0), btVector3(90, 0, 0), hit);
    EXPECT_EQ(hit.proxies.size(), 40u) << kind;
  }
}

TEST(BulletContract, Q5_DirectionComesFromTheInverse) {
  Rig rig;
  const btBroadphaseProxy* proxy = rig.create(cube(5, 0, 0));
  rig.create(cube(0, 5, 0));
  FoundOnRay ray(btVector3(0, 0, 0), btVector3(10, 0, 0));
  for (const btVector3& rubbish : {btVector3(0, 10, 0), btVector3(nan, nan, nan), btVector3(-10, 0, 0)}) {
    ray.proxies.clear();
    rig.broadphase->rayTest(btVector3(0, 0, 0), rubbish, ray);
    EXPECT_EQ(ray.proxies, std::vector<const btBroadphaseProxy*>{proxy});
  }
}

TEST(BulletContract, Q5_HugeInversesAndSigns) {
  for (const btScalar huge : {btScalar(1e18), btScalar(1e30), std::numeric_limits<btScalar>::infinity()})
    for (int axis = 0; axis < 3; ++axis)
      for (const btScalar sign : {btScalar(1), btScalar(-1)}) {
        Rig rig;
        btVector3 at(btScalar(0.25), btScalar(-0.25), btScalar(0.125));
        at[axis] = 7 * sign;
        const btBroadphaseProxy* hit = rig.create(cube(at.x(), at.y(), at.z()));
        at[axis] = -7 * sign;
        rig.create(cube(at.x(), at.y(), at.z()));  // behind
        at[axis] = 17 * sign;
        rig.create(cube(at.x(), at.y(), at.z()));  // beyond the end
        at[axis] = 7 * sign;
        at[(axis + 1) % 3] += 2;
        rig.create(cube(at.x(), at.y(), at.z()));  // beside
        btVector3 to(0, 0, 0);
        to[axis] = 10 * sign;
        FoundOnRay ray(btVector3(0, 0, 0), to, huge);
        rig.broadphase->rayTest(btVector3(0, 0, 0), to, ray);
        EXPECT_EQ(ray.proxies, std::vector<const btBroadphaseProxy*>{hit}) << huge << ' ' << axis << ' ' << sign;
      }
}

TEST(BulletContract, Q6_ExtentsSweepABox) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    const btBroadphaseProxy* proxy = rig.create(cube(5, 2, 0));  // y from 1.5 to 2.5
    const btVector3 from(0, 0, 0), to(10, 0, 0);
    const auto hit = [&](const btVector3& lo, const btVector3& hi) {
      return contains(rig.on_ray(from, to, lo, hi), proxy);
    };
    EXPECT_FALSE(hit(btVector3(0, 0, 0), btVector3(0, 0, 0))) << kind;
    EXPECT_TRUE(hit(btVector3(0, 0, 0), btVector3(0, btScalar(1.6), 0))) << kind;
    EXPECT_FALSE(hit(btVector3(0, btScalar(-1.6), 0), btVector3(0, 0, 0))) << kind;  // reaches down, not up
    EXPECT_TRUE(hit(btVector3(0, btScalar(2.4), 0), btVector3(0, 3, 0))) << kind;    // both above the origin
    EXPECT_FALSE(hit(btVector3(0, btScalar(2.6), 0), btVector3(0, 3, 0))) << kind;
    EXPECT_TRUE(
        contains(rig.on_ray(btVector3(0, 2, 0), btVector3(4, 2, 0), btVector3(-1, -1, -1), btVector3(1, 1, 1)), proxy))
        << kind;
  }
}

/// Where the segment is inside the box, by slabs in long double; grown by `grow` on all sides.
bool segment_meets(const btVector3& from, const btVector3& to, const btVector3& lo, const btVector3& hi, double grow) {
  long double enter = 0, leave = 1;
  for (int d = 0; d < 3; ++d) {
    const long double a = from[d], b = to[d], l = static_cast<long double>(lo[d]) - grow,
                      h = static_cast<long double>(hi[d]) + grow;
    if (a == b) {
      if (a < l || a > h) return false;
      continue;
    }
    long double t0 = (l - a) / (b - a), t1 = (h - a) / (b - a);
    if (t0 > t1) std::swap(t0, t1);
    enter = std::max(enter, t0);
    leave = std::min(leave, t1);
  }
  return enter <= leave;
}

TEST(BulletContract, Q7_StrictHitsAreFoundAndClearMissesAreNot) {
  Random random(7);
  Rig dbvt(Kind::dbvt), subject;
  std::vector<btBroadphaseProxy*> proxies[2];
  for (int i = 0; i < 600; ++i) {
    const btVector3 p = random.vector(-10, 10);
    const Box box = cube(p.x(), p.y(), p.z(), random.real(btScalar(0.05), 1));
    proxies[0].push_back(dbvt.create(box));
    proxies[1].push_back(subject.create(box));
  }
  int strict = 0, reported = 0;
  for (int ray = 0; ray < 400; ++ray) {
    const btVector3 from = random.vector(-12, 12);
    btVector3 to = random.vector(-12, 12);
    if (ray % 4 == 0) to[ray / 4 % 3] = from[ray / 4 % 3];              // in a plane
    if (ray % 8 == 0) to[(ray / 4 + 1) % 3] = from[(ray / 4 + 1) % 3];  // along an axis
    btVector3 lo(0, 0, 0), hi(0, 0, 0);
    if (ray % 3 == 0) lo = random.vector(-1, 0), hi = random.vector(0, 1);
    for (int which = 0; which < 2; ++which) {
      Rig& rig = which ? subject : dbvt;
      const std::vector<const btBroadphaseProxy*> found = rig.on_ray(from, to, lo, hi);
      for (const btBroadphaseProxy* proxy : proxies[which]) {
        const btVector3 box_lo = proxy->m_aabbMin - hi, box_hi = proxy->m_aabbMax - lo;
        const bool hit = std::binary_search(found.begin(), found.end(), proxy);
        if (segment_meets(from, to, box_lo, box_hi, -1e-4)) {
          ASSERT_TRUE(hit) << "ray " << ray << (which ? ": boxstream" : ": Dbvt") << " misses a box";
          strict += which;
        } else if (which && !segment_meets(from, to, box_lo, box_hi, 1e-4)) {
          ASSERT_FALSE(hit) << "ray " << ray << " reports a box that it passes";
        }
        reported += which && hit;
      }
    }
  }
  EXPECT_GT(strict, 1000);
  EXPECT_GT(reported, 1000);
}

TEST(BulletContract, Q7_RayFromInsideHits) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    const btBroadphaseProxy* around = rig.create(cube(0, 0, 0, 5));
    EXPECT_TRUE(contains(rig.on_ray(btVector3(0, 0, 0), btVector3(1, 1, 1)), around)) << kind;    // wholly inside
    EXPECT_TRUE(contains(rig.on_ray(btVector3(0, 0, 0), btVector3(90, 0, 1)), around)) << kind;   // out of it
    EXPECT_TRUE(contains(rig.on_ray(btVector3(0, -90, 0), btVector3(1, 0, 1)), around)) << kind;  // into it
  }
}

TEST(BulletContract, Q8_ZeroLengthSweepIsAnOverlapTest) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    for (const btScalar huge : {BT_LARGE_FLOAT, btScalar(1e30)}) {
      Rig rig(kind);
      const btBroadphaseProxy* around = rig.create(cube(0, 0, 0, 2));
      rig.create(cube(10, 0, 0, 2));
      FoundOnRay sweep(btVector3(0, 0, 0), btVector3(1, 0, 0));
      sweep.m_rayDirectionInverse.setValue(huge, huge, huge);
      sweep.m_signs[0] = sweep.m_signs[1] = sweep.m_signs[2] = 0;
      sweep.m_lambda_max = 0;
      const btVector3 origin(btScalar(0.5), btScalar(-0.5), btScalar(0.25));
      rig.broadphase->rayTest(origin, origin, sweep);
      EXPECT_EQ(sweep.proxies, std::vector<const btBroadphaseProxy*>{around}) << kind;
      sweep.proxies.clear();
      rig.broadphase->rayTest(btVector3(btScalar(2.5), 0, 0), btVector3(0, 0, 0), sweep, btVector3(-1, -1, -1),
                              btVector3(1, 1, 1));
      EXPECT_EQ(sweep.proxies, std::vector<const btBroadphaseProxy*>{around}) << kind;
    }
  }
}

TEST(BulletContract, Q8_NanRayDoesNotCrash) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    for (int i = 0; i < 100; ++i) rig.create(cube(btScalar(i), 0, 0));
    FoundOnRay ray(btVector3(0, 0, 0), btVector3(1, 0, 0));
    ray.m_rayDirectionInverse.setValue(nan, nan, nan);
    ray.m_lambda_max = nan;
    rig.broadphase->rayTest(btVector3(0, 0, 0), btVector3(0, 0, 0), ray);
    EXPECT_LE(ray.proxies.size(), 100u) << kind;
    if (kind == Kind::subject) {
      FoundOnRay from_nowhere(btVector3(0, 0, 0), btVector3(1, 0, 0));
      rig.broadphase->rayTest(btVector3(nan, 0, 0), btVector3(1, 0, 0), from_nowhere);
      Found in_nothing;
      rig.broadphase->aabbTest(btVector3(nan, nan, nan), btVector3(nan, nan, nan), in_nothing);
      EXPECT_TRUE(in_nothing.proxies.empty());
      EXPECT_EQ(rig.in_box(cube(50, 0, 0, btScalar(0.1))).size(), 1u);
    }
  }
}

TEST(BulletContract, Q9_TouchingCountsAndPointsAreLegal) {
  for (const Kind kind : all_kinds) {
    if (kind == Kind::axis16 || kind == Kind::axis32) continue;  // proxies of the accelerator
    Rig rig(kind);
    const btBroadphaseProxy* box = rig.create(cube(0, 0, 0));
    const btBroadphaseProxy* point = rig.create(cube(4, 0, 0, 0));
    EXPECT_TRUE(contains(rig.in_box(cube(1, 0, 0)), box)) << kind;                             // face
    EXPECT_TRUE(contains(rig.in_box(cube(-1, 1, -1)), box)) << kind;                           // corner
    EXPECT_TRUE(contains(rig.in_box(cube(btScalar(0.5), btScalar(0.5), 0, 0)), box)) << kind;  // point on edge
    EXPECT_TRUE(contains(rig.in_box(cube(0, 0, 0, 0)), box)) << kind;                          // point inside
    EXPECT_TRUE(contains(rig.in_box(cube(4, 0, 0, 0)), point)) << kind;                        // point on point
    EXPECT_TRUE(contains(rig.in_box(cube(btScalar(3.5), 0, 0)), point)) << kind;
    const btScalar beyond = std::nextafter(btScalar(0.5), btScalar(1));
    EXPECT_FALSE(contains(rig.in_box(cube(beyond, 0, 0, 0)), box)) << kind;
  }
}

TEST(BulletContract, Q10_NestedQueries) {
  Rig rig;
  Random random(10);
  for (int i = 0; i < 300; ++i) {
    const btVector3 p = random.vector(-5, 5);
    rig.create(cube(p.x(), p.y(), p.z()));
  }
  const Box box = cube(0, 0, 0, 2);
  const btVector3 from(-9, 1, 0), to(9, -1, 0);
  const auto flat_box = rig.in_box(box);
  const auto flat_ray = rig.on_ray(from, to);
  ASSERT_GT(flat_box.size(), 10u);
  ASSERT_GT(flat_ray.size(), 3u);
  for (int pending = 0; pending < 2; ++pending) {
    if (pending) {  // an update of the index is due when the outer query starts
      btBroadphaseProxy* extra = rig.create(cube(90, 0, 0));
      rig.move(extra, cube(95, 0, 0));
    }
    FoundOnRay outer(from, to);
    int inner_runs = 0;
    outer.also = [&](const btBroadphaseProxy*) {
      EXPECT_EQ(rig.on_ray(from, to), flat_ray);
      Found middle;
      middle.also = [&](const btBroadphaseProxy*) {
        if (++inner_runs % 10 == 0) {
          EXPECT_EQ(rig.on_ray(from, to), flat_ray);
        }
      };
      rig.broadphase->aabbTest(box.lo, box.hi, middle);
      EXPECT_EQ(sorted(middle.proxies), flat_box);
    };
    rig.broadphase->rayTest(from, to, outer);
    EXPECT_EQ(sorted(outer.proxies), flat_ray);
    EXPECT_EQ(inner_runs, static_cast<int>(flat_ray.size() * flat_box.size()));
  }
}

TEST(BulletContract, Q10_QueriesInsideNearCallbackAndFilter) {
  Rig rig;
  btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
  btSphereShape sphere(1);
  std::deque<btCollisionObject> objects(10);
  for (int i = 0; i < 10; ++i) {
    objects[static_cast<std::size_t>(i)].setCollisionShape(&sphere);
    objects[static_cast<std::size_t>(i)].getWorldTransform().setOrigin(btVector3(btScalar(i), 0, 0));
    world.addCollisionObject(&objects[static_cast<std::size_t>(i)]);
  }
  static Rig* current;
  static int near_calls;
  current = &rig;
  near_calls = 0;
  rig.dispatcher.setNearCallback(
      [](btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info) {
        ++near_calls;
        EXPECT_EQ(current->on_ray(btVector3(-9, 0, 0), btVector3(30, 0, 0)).size(), 10u);
        EXPECT_EQ(current->in_box(cube(0, 0, 0, 50)).size(), 10u);
        btCollisionDispatcher::defaultNearCallback(pair, dispatcher, info);
      });
  world.performDiscreteCollisionDetection();
  EXPECT_EQ(near_calls, rig.pair_count());
  EXPECT_GT(near_calls, 10);
  for (btCollisionObject& object : objects) world.removeCollisionObject(&object);
}

TEST(BulletContract, Q11_QueriesChangeNothing) {
  Rig rig, untouched;
  Random random(11), asking(12);
  std::vector<btBroadphaseProxy*> a, b;
  for (int i = 0; i < 200; ++i) {
    const btVector3 p = random.vector(-4, 4);
    a.push_back(rig.create(cube(p.x(), p.y(), p.z())));
    b.push_back(untouched.create(cube(p.x(), p.y(), p.z())));
  }
  for (int frame = 0; frame < 30; ++frame) {
    for (std::size_t i = 0; i < 200; ++i) {
      const btVector3 p = random.vector(-4, 4);
      rig.move(a[i], cube(p.x(), p.y(), p.z()));
      untouched.move(b[i], cube(p.x(), p.y(), p.z()));
      if (i % 50 == 0) {
        const btVector3 q = asking.vector(-4, 4);
        rig.in_box(cube(q.x(), q.y(), q.z()));
        rig.on_ray(q, -q);
      }
    }
    rig.calculate();
    untouched.calculate();
    ASSERT_EQ(rig.pairs(), untouched.pairs()) << "frame " << frame;
  }
}

}  // namespace
}  // namespace boxstream::bullet_test
