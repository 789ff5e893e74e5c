// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "peers/fcl_managers.hpp"
#include "users/fcl_things.hpp"

namespace boxstream::bench {

/// The managers of one kind in one world.
class FclUse {
 public:
  virtual ~FclUse() = default;
  /// A frame, as its user writes it. All of it is timed.
  virtual void run(FclAsked& asked) = 0;
};

/// A world; its things exist already, and may be known to the managers of several kinds.
class FclUser {
 public:
  virtual ~FclUser() = default;
  /// Puts the things where they are in this frame, whatever was before. Not timed: it is the same for all.
  virtual void go_to(int frame) = 0;
  /// Managers that are filled, and set up.
  virtual std::unique_ptr<FclUse> open(const FclManagerKind& kind) = 0;
};

struct FclUserCase {
  std::string_view name;
  std::string_view description;
  std::vector<std::size_t> sizes;  ///< the first and the last are left out by `--quick`
  std::unique_ptr<FclUser> (*make)(const FclUserCase& of, std::size_t n, std::uint64_t seed);
  /// With fewer things no callback sets a limit, and FCL's sweeps never end.
  std::size_t sets_limit_from = 0;
  std::size_t others = 0;    ///< things beside the n
  bool trees_alone = false;  ///< other managers would take too long, or lose what is registered one by one
};

std::vector<FclUserCase> fcl_robot_cases();
std::vector<FclUserCase> fcl_body_cases();
std::vector<FclUserCase> fcl_crowd_cases();

inline std::unique_ptr<FclManager> filled(const FclManagerKind& kind, const FclThings& things) {
  std::unique_ptr<FclManager> manager = kind.make({});
  manager->registerObjects(things.pointers);
  manager->setup();
  return manager;
}

/// One by one, as Drake does it. (FCL's trees crash when they are given a half-space together with others.)
inline std::unique_ptr<FclManager> filled_one_by_one(const FclManagerKind& kind, const FclThings& things) {
  std::unique_ptr<FclManager> manager = kind.make({});
  for (auto* const thing : things.pointers) manager->registerObject(thing);
  manager->setup();
  return manager;
}

}  // namespace boxstream::bench
