// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/world.hpp>

namespace boxstream::javascript {

/// Ids as numbers of JavaScript: the slot plus one, from bit 32 on the generation less one. 0 is none. An integer has
/// 53 bits there: of the generation the lower 21 are told, and the rest is that of the proxy which has the slot now. So
/// the id of a destroyed proxy stays stale until its slot has been used two million times more.
class Ids {
 public:
  static double number(ProxyId id);

  /// After `reserve` with the number of new ids, `note` needs no memory.
  /// It at least doubles what there was, so that many calls for one each take no longer than one for all.
  void reserve(std::size_t more) {
    const std::size_t size = generations_.size();
    if (generations_.capacity() - size < more) generations_.reserve(std::max(size + more, 2 * size));
  }
  void note(ProxyId id);
  void clear() { generations_.clear(); }

  /// Null for what is not a number of an id.
  ProxyId id(double number) const;
  std::vector<ProxyId> ids(Span<const double> numbers) const;

 private:
  std::vector<std::uint32_t> generations_;  // by slot, of the last proxy that got it
};

}  // namespace boxstream::javascript
