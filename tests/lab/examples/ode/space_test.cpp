// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "examples/ode/space.hpp"

namespace boxstream {
namespace {

using Pairs = std::vector<std::pair<dGeomID, dGeomID>>;

void note(void* pairs, dGeomID a, dGeomID b) {
  static_cast<Pairs*>(pairs)->push_back(std::minmax(a, b));
}

Pairs sorted(Pairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Balls, boxes, capsules and a plane, some of one body, some disabled, in a space of ODE's and one of ours.
class Twins {
 public:
  explicit Twins(int count, unsigned seed)
      : random_(seed), world_(dWorldCreate()), theirs_(dSimpleSpaceCreate(nullptr)) {
    add(dCreatePlane(nullptr, 0, 0, 1, 1));
    for (int i = 0; i < count; ++i) add_any();
    ours_.update();  // with a geom its body moves, and all others of that
  }
  ~Twins() {
    dSpaceDestroy(theirs_);
    dWorldDestroy(world_);
  }
  Twins(const Twins&) = delete;
  Twins& operator=(const Twins&) = delete;

  void add_any() {
    const dReal size = static_cast<dReal>(number(0.2, 1.2));
    const dGeomID geom = random_() % 3 == 0   ? dCreateSphere(nullptr, size)
                         : random_() % 2 == 0 ? dCreateBox(nullptr, size, 2 * size, size)
                                              : dCreateCapsule(nullptr, size / 2, size);
    add(geom);
    if (random_() % 3 != 0) {
      if (bodies_.empty() || random_() % 4 != 0) bodies_.push_back(dBodyCreate(world_));
      dGeomSetBody(geom, bodies_.back());
    }
    move(geom);
    dGeomSetCategoryBits(geom, 1ul << random_() % 3);
    dGeomSetCollideBits(geom, random_() % 8);
  }

  void change() {
    for (std::size_t i = 1; i < geoms_.size(); ++i)
      if (random_() % 2 == 0) move(geoms_[i]);
    const dGeomID any = geoms_[1 + random_() % (geoms_.size() - 1)];
    if (random_() % 3 == 0)
      dGeomDisable(any);
    else
      dGeomEnable(any);
    if (random_() % 4 == 0) {
      const std::size_t gone = 1 + random_() % (geoms_.size() - 1);
      ours_.remove(geoms_[gone]);
      dGeomDestroy(geoms_[gone]);
      geoms_.erase(geoms_.begin() + static_cast<std::ptrdiff_t>(gone));
      add_any();
    }
    ours_.update();
  }

  void expect_same() {
    Pairs theirs, ours;
    dSpaceCollide(theirs_, &theirs, note);
    ours_.collide(&ours, note);
    ASSERT_EQ(sorted(ours), sorted(theirs));
    ASSERT_FALSE(ours.empty());
    for (std::size_t i = 0; i < geoms_.size(); i += 7) {
      Pairs expected, found;
      for (const auto& pair : theirs)
        if (pair.first == geoms_[i] || pair.second == geoms_[i]) expected.push_back(pair);
      ours_.collide(geoms_[i], &found, note);
      ASSERT_EQ(sorted(found), sorted(expected));
      if (!expected.empty()) {
        ASSERT_NE(ours_.nearest(geoms_[i], 1), nullptr);
      }
    }
  }

  /// Each with those of the other that it meets.
  void expect_same(const Twins& other) {
    Pairs theirs, ours;
    dSpaceCollide2(reinterpret_cast<dGeomID>(theirs_), reinterpret_cast<dGeomID>(other.theirs_), &theirs, note);
    ours_.collide(other.ours_, &ours, note);
    ASSERT_EQ(sorted(ours), sorted(theirs));
    ASSERT_FALSE(ours.empty());
  }

 private:
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  void add(dGeomID geom) {
    geoms_.push_back(geom);
    dSpaceAdd(theirs_, geom);
    ours_.add(geom);
  }
  void move(dGeomID geom) {
    dGeomSetPosition(geom, static_cast<dReal>(number(-4, 4)), static_cast<dReal>(number(-4, 4)),
                     static_cast<dReal>(number(0, 6)));
    ours_.update(geom);
  }

  std::mt19937 random_;
  dWorldID world_;
  dSpaceID theirs_;
  ode::Space ours_;
  std::vector<dBodyID> bodies_;
  std::vector<dGeomID> geoms_;
};

class OdeSpace : public testing::Test {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }
};

TEST_F(OdeSpace, HasThePairsOfOdesOwn) {
  for (const int count : {40, 400}) {
    Twins twins(count, 1), others(count / 4, 2);
    for (int frame = 0; frame < 30; ++frame) {
      twins.change();
      twins.expect_same();
      twins.expect_same(others);
    }
  }
}

}  // namespace
}  // namespace boxstream
