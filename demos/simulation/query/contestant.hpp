// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include "simulation/query/objects.hpp"

namespace boxstream::query {

/// A pair that touches, or is within the limit.
struct Hit {
  std::uint32_t a = 0;  // object indices, a < b
  std::uint32_t b = 0;
  std::uint32_t contacts = 0;
  double distance = 0;

  friend bool operator==(const Hit& x, const Hit& y) {
    return x.a == y.a && x.b == y.b && x.contacts == y.contacts && x.distance == y.distance;
  }
};

/// What one query of one step gave.
struct Answer {
  std::vector<Hit> hits;  // sorted, each pair once; empty for Kind::first and Kind::distance
  bool touching = false;
  double distance = std::numeric_limits<double>::infinity();  // least one; Kind::distance and Kind::within
  std::uint64_t callbacks = 0;
  std::uint64_t skipped = 0;   // of these: parts that belong together
  std::uint64_t failures = 0;  // of these: FCL's narrow phase threw; the pair then counts as touching, without contacts
  std::uint64_t contacts = 0;
  double broad_ms = 0;   // the query without what follows
  double narrow_ms = 0;  // inside FCL's narrow phase
};

/// One manager for each group of a scene.
class Contestant {
 public:
  /// Registers all objects.
  Contestant(const std::string& name, const QueryScene& scene, const ObjectMotion& motion, const Objects& objects);

  /// Tells the managers what moved. Returns the time in milliseconds.
  double update();
  Answer ask(const Query& query) const;

  const std::string& name() const { return name_; }
  double register_ms() const { return register_ms_; }

 private:
  std::string name_;
  const ObjectMotion& motion_;
  const Objects& objects_;
  std::vector<std::unique_ptr<Manager>> managers_;
  double register_ms_ = 0;
};

}  // namespace boxstream::query
