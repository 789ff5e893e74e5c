// SPDX-License-Identifier: MIT
// Compiled without RTTI, and linked with a file that has it: managers of one meet those of the other. By names that
// work beside `using namespace boxstream;`.
#include <boxstream/boxstream.hpp>
#include <boxstream/fcl.hpp>

#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/geometry/shape/sphere.h>

#include <cstdio>
#include <memory>
#include <vector>

#ifdef __GXX_RTTI
#error "this file is to be compiled without RTTI"
#endif

using namespace boxstream;
using boxstream::fcl::CollisionManager;
namespace bf = boxstream::fcl;

/// With RTTI.
std::size_t pairs_with_rtti(CollisionManager<double>& mine, ::fcl::BroadPhaseCollisionManager<double>& other);
std::unique_ptr<CollisionManager<double>> manager_with_rtti();

namespace {

using Object = ::fcl::CollisionObject<double>;

std::size_t pairs(const CollisionManager<double>& mine, ::fcl::BroadPhaseCollisionManager<double>& other) {
  std::size_t calls = 0;
  mine.collide(&other, &calls, [](Object*, Object*, void* count) {
    ++*static_cast<std::size_t*>(count);
    return false;
  });
  return calls;
}

bool expect(std::size_t is, std::size_t ought, const char* what) {
  if (is != ought) std::printf("%s: %zu pairs, not %zu\n", what, is, ought);
  return is == ought;
}

}  // namespace

int main() {
  const auto sphere = std::make_shared<::fcl::Sphere<double>>(0.5);
  Object a(sphere), b(sphere);
  bf::CollisionManager<double> here, also_here;
  const auto there = manager_with_rtti();
  ::fcl::NaiveCollisionManager<double> foreign;
  here.registerObject(&a);
  for (::fcl::BroadPhaseCollisionManager<double>* other :
       std::vector<::fcl::BroadPhaseCollisionManager<double>*>{&also_here, there.get(), &foreign})
    other->registerObject(&b);
  // Only managers of another type are asked where their objects are now.
  b.setTranslation(::fcl::Vector3<double>(9, 0, 0));
  b.computeAABB();
  bool good = expect(pairs(here, also_here), 1, "both without RTTI");
  good &= expect(pairs(here, *there), 1, "the other with RTTI");
  good &= expect(pairs(*there, here), 1, "the first with RTTI");
  good &= expect(pairs_with_rtti(here, *there), 1, "asked with RTTI");
  good &= expect(pairs_with_rtti(*there, here), 1, "asked with RTTI for one without");
  good &= expect(pairs(here, foreign), 0, "a foreign one");
  good &= expect(pairs_with_rtti(here, foreign), 0, "a foreign one, asked with RTTI");
  good &= expect(find_pairs(std::vector<Aabb>{{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}}).size(), 1, "the core");
  return good ? 0 : 1;
}
