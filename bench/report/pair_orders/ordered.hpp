// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include "pair_orders/pair_sorter.hpp"

class btBroadphaseInterface;

namespace boxstream::report {

/// boxstream, with a pair cache that delivers its pairs to the narrow phase in the given order.
std::unique_ptr<btBroadphaseInterface> make_ordered_pairs(const PairOrder& order, const btVector3& gravity);

/// Bullet's solver, which solves the contacts of an island in the given order.
class OrderedSolver final : public btSequentialImpulseConstraintSolver {
 public:
  explicit OrderedSolver(PairSorter sorter) : sorter_(std::move(sorter)) {}

 private:
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override;

  PairSorter sorter_;
  std::vector<btPersistentManifold*> sorted_;
};

}  // namespace boxstream::report
