// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "answer.hpp"
#include "ids.hpp"
#include "views.hpp"

namespace boxstream::javascript {

/// A World of float or double, with ids as JavaScript has them.
struct WorldHandle {
  WorldHandle(Scalar scalar, const WorldOptions& options);

  std::variant<World, World64> world;
  Ids known;
};

/// Calls `work(world)`, and says how it went.
template <class Work>
Status with_world(WorldHandle* handle, Work work) {
  return guarded([&] { std::visit(work, handle->world); });
}

inline void answer_with(double number) {
  answer.numbers[0] = number;
}

}  // namespace boxstream::javascript
