// SPDX-License-Identifier: MIT
#include "peers/fcl_managers.hpp"

#include <boxstream/fcl.hpp>

namespace boxstream::bench {

std::vector<FclManagerKind> fcl_manager_kinds() {
  std::vector<FclManagerKind> kinds = fcl_own_manager_kinds();
  const auto make_ours = [](Span<const Aabb>) -> std::unique_ptr<FclManager> {
    return std::make_unique<boxstream::fcl::CollisionManager<double>>();
  };
  const auto make_hybrid = [](Span<const Aabb>) -> std::unique_ptr<FclManager> {
    DetectorOptions options;
    options.method = Method::hybrid;
    return std::make_unique<boxstream::fcl::CollisionManager<double>>(options);
  };
  kinds.insert(kinds.begin(), {{.name = "ours", .make = make_ours}, {.name = "hybrid", .make = make_hybrid}});
  return kinds;
}

}  // namespace boxstream::bench
