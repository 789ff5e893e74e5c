// SPDX-License-Identifier: MIT
// The contract of managers, which Coal's share: ../managers/contract.hpp.
#include <fcl/broadphase/broadphase_bruteforce.h>

#include "managers/contract.hpp"
#include "support.hpp"

namespace boxstream::managers_test {
namespace {

template <class S>
struct Fcl {
  using Scalar = S;
  using Object = ::fcl::CollisionObject<S>;
  using Base = ::fcl::BroadPhaseCollisionManager<S>;
  using Manager = boxstream::fcl::CollisionManager<S>;
  using Foreign = ::fcl::NaiveCollisionManager<S>;

  static std::unique_ptr<Object> object() {
    return std::make_unique<fcl_test::BoxObject<S>>(fcl_test::cube<S>(0, 0, 0));
  }
  static void set(Object& object, const std::array<S, 3>& lo, const std::array<S, 3>& hi) {
    static_cast<fcl_test::BoxObject<S>&>(object).set(fcl_test::make_box<S>(lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]));
  }
  template <class OnPair, class... Of>
  static void collide(const Base& manager, OnPair&& on_pair, Of&... of) {
    manager.collide(&of..., &on_pair, [](Object* a, Object* b, void* use) {
      return (*static_cast<std::remove_reference_t<OnPair>*>(use))(a, b);
    });
  }
  template <class OnPair, class... Of>
  static void distance(const Base& manager, OnPair&& on_pair, Of&... of) {
    manager.distance(&of..., &on_pair, [](Object* a, Object* b, void* use, S& least) {
      return (*static_cast<std::remove_reference_t<OnPair>*>(use))(a, b, least);
    });
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Fcl32, Contract, Fcl<float>);
INSTANTIATE_TYPED_TEST_SUITE_P(Fcl64, Contract, Fcl<double>);

}  // namespace
}  // namespace boxstream::managers_test
