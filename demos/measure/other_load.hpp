// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::measure {

/// How busy others keep the machine while this process measures. Processors share caches, memory and often a core: work
/// that others do beside a pinned thread makes it slower, and no clock of that thread shows it.
class OtherLoad {
 public:
  /// Since this object was made: processors kept busy by other processes, 0 to all of them. NaN where the system does
  /// not tell.
  double processors() const;

 private:
  /// Seconds, of all processors together.
  struct Spent {
    double elapsed, busy, own;
  };
  static Spent now();

  Spent start_ = now();
};

}  // namespace boxstream::measure
