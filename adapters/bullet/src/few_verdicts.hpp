// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/bullet/precision.hpp>

#include "pair_store.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Of very few proxies, which pairs are held, a bit for each. A batch in which the boxes that have moved touch what
/// they are held with, and nothing else, is over then. The World hears of their boxes when there is more to do, or a
/// query. A look at all pairs is so little there that rooms (see ProxyRooms) would save nothing.
class FewVerdicts {
 public:
  using Proxies = std::vector<Proxy*>;

  static constexpr std::size_t most = 12;

  /// Until the next search.
  void forget() noexcept { are_known_ = false; }

  void note_move(const Proxy& proxy) { moved_ |= bit(proxy.position); }
  /// The last one of all, which is held with nothing.
  void note_created(const Proxy& proxy) {
    if (proxy.position >= most) return note_many();
    held_[proxy.position] = 0;
    note_move(proxy);
  }
  /// Before the last one of `size` takes its place.
  void note_destroyed(const Proxy& proxy, std::size_t size);

  /// After a search that has seen all changes: `pairs` are those that are held.
  void learn(const Proxies& live, PairStore& pairs);

  /// True if nothing begins or ends by what has moved since this was last asked with that answer, or learned.
  /// `by_masks`: group and mask refuse pairs, and nothing else does. Calls `visit(proxy)` for what has moved then.
  template <class Visit>
  bool hold(const Proxies& live, bool by_masks, Visit&& visit) {
    if (!are_known_ || !touch_as_held(live, by_masks)) return false;
    for (const Proxy* proxy : live)
      if ((moved_ & bit(proxy->position)) != 0) visit(*proxy);
    moved_ = 0;
    return true;
  }

  /// For pairs that are settled.
  void validate(const Proxies& live, PairStore& pairs, bool by_masks) const;

 private:
  static std::uint32_t bit(std::uint32_t position) { return 1u << position % 32; }
  bool are_held(std::uint32_t a, std::uint32_t b) const { return (held_[a] & bit(b)) != 0; }
  bool touch_as_held(const Proxies& live, bool by_masks) const;
  void note_many() noexcept {
    forget();
    searches_left_ = searches_after_many;
  }

  /// In these, memory that many proxies took goes back.
  static constexpr unsigned searches_after_many = 12;

  bool are_known_ = true;  // at first there are none
  std::uint32_t moved_ = 0;
  std::uint32_t held_[most];
  unsigned searches_left_ = 0;  // before this may take part
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
