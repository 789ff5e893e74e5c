// SPDX-License-Identifier: MIT
// A program that knows nothing of boxstream and uses each manager of FCL. It prints what is the same for all of them.
#include <fcl/fcl.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using Object = fcl::CollisionObjectd;

bool count(Object* a, Object* b, void* data) {
  *static_cast<int*>(data) += a != b && a->getAABB().overlap(b->getAABB());
  return false;
}

/// One of FCL's managers reports pairs of two managers twice.
bool collect(Object* a, Object* b, void* data) {
  static_cast<std::set<std::pair<Object*, Object*>>*>(data)->emplace(a, b);
  return false;
}

bool nearest(Object* a, Object* b, void* data, double& distance) {
  auto& least = *static_cast<double*>(data);
  if (a != b) least = std::min(least, a->getAABB().distance(b->getAABB()));
  distance = least;
  return false;
}

struct Derived : fcl::DynamicAABBTreeCollisionManagerd {
  int asked = 0;
  using fcl::DynamicAABBTreeCollisionManagerd::collide;
  void collide(void* data, fcl::CollisionCallBack<double> callback) const override {
    const_cast<Derived*>(this)->asked++;
    fcl::DynamicAABBTreeCollisionManagerd::collide(data, callback);
  }
};

template <class Manager>
void use(const char* name) {
  std::mt19937 random(77);
  std::uniform_real_distribution<double> in(-12, 12);
  const auto shape = std::make_shared<fcl::Boxd>(1.1, 0.7, 1.9);
  std::vector<std::unique_ptr<Object>> objects;
  Manager a, b;
  for (int i = 0; i < 300; ++i) {
    objects.push_back(std::make_unique<Object>(shape));
    objects.back()->setTranslation(fcl::Vector3d(in(random), in(random), in(random)));
    objects.back()->computeAABB();
    (i % 3 == 0 ? b : a).registerObject(objects.back().get());
  }
  a.setup();
  b.setup();
  int pairs = 0, between = 0, of_one = 0;
  double sum = 0;
  for (int step = 0; step < 10; ++step) {
    for (std::size_t i = 0; i < objects.size(); i += 7) {
      objects[i]->setTranslation(fcl::Vector3d(in(random), in(random), in(random)));
      objects[i]->computeAABB();
    }
    if (step == 5) {
      b.unregisterObject(objects[0].get());
      a.registerObject(objects[0].get());
    }
    a.update();
    b.update();
    a.collide(&pairs, count);
    std::set<std::pair<Object*, Object*>> of_two;
    a.collide(&b, &of_two, collect);
    between += static_cast<int>(of_two.size());
    for (std::size_t i = 0; i < 40; ++i) b.collide(objects[i].get(), &of_one, count);
    double here = 1e9;
    b.distance(objects[1].get(), &here, nearest);
    sum += here;
    here = 1e9;
    a.distance(&here, nearest);
    sum += here;
  }
  std::printf("%s: %d pairs, %d between two, %d of one, sum of least distances %.12g, %zu + %zu objects\n", name, pairs,
              between, of_one, sum, a.size(), b.size());
}

}  // namespace

int main() {
  use<fcl::DynamicAABBTreeCollisionManagerd>("tree");
  use<fcl::DynamicAABBTreeCollisionManager_Arrayd>("array tree");
  use<fcl::IntervalTreeCollisionManagerd>("interval tree");
  use<fcl::NaiveCollisionManagerd>("naive");
  use<fcl::SSaPCollisionManagerd>("ssap");
  use<fcl::SaPCollisionManagerd>("sap");
  use<Derived>("derived");
}
