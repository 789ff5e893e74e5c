// SPDX-License-Identifier: MIT
// Each allocation fails, libccd's own too: std::bad_alloc, never another answer.
#include <gtest/gtest.h>
#include <boxstream/ccd.hpp>

#include <cstdint>
#include <cstdlib>
#include <new>

extern "C" void* __libc_malloc(std::size_t bytes);

namespace {

bool is_counting = false;
std::int64_t number = 0, failing = -1;

}  // namespace

/// What libccd and operator new take their memory from.
extern "C" void* malloc(std::size_t bytes) {
  return is_counting && number++ == failing ? nullptr : __libc_malloc(bytes);
}

namespace boxstream::ccd {
namespace {

/// Allocations of the query.
template <class Query>
std::int64_t count(Query&& query, std::int64_t fails = -1) {
  struct Counting {
    Counting() { is_counting = true; }
    ~Counting() { is_counting = false; }
  };
  number = 0;
  failing = fails;
  const Counting counting;
  query();
  return number;
}

TEST(Memory, EachAllocationMayFail) {
  const ConvexHull hull{{{1, 0, 0}, {-1, 0.1, 0}, {0, 1, 0.2}, {0, -1, 0}, {0.1, 0, 1}, {0, 0.2, -1}, {0.6, 0.6, 0.6}}};
  const Shape shapes[] = {hull, Cone{1, 2}, Cylinder{0.5, 1}, Capsule{0.3, 1}, Sphere{0.7}, Box{{0.5, 0.4, 0.3}}};
  const Pose here, there(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.6, 0, 0.8)).toRotationMatrix(), {0.3, 0.2, 0.1});
  std::int64_t failed = 0;
  for (const Shape& a : shapes)
    for (const Shape& b : shapes) {
      const Penetration truth = penetration(a, here, b, there);
      Penetration found;
      const auto query = [&] { found = penetration(a, here, b, there); };
      const std::int64_t allocations = count(query);
      for (std::int64_t i = 0; i < allocations; ++i) {
        EXPECT_THROW(count(query, i), std::bad_alloc) << "shapes " << a.index() << ", " << b.index();
        ++failed;
        query();
        EXPECT_EQ(found.depth, truth.depth);
        EXPECT_EQ(found.status, truth.status);
      }
    }
  EXPECT_GT(failed, 100) << "hardly anything was put to the test";
}

}  // namespace
}  // namespace boxstream::ccd
