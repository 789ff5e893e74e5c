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
/// query.
///
/// Rooms (see ProxyRooms) take no look at other boxes, but have to be made, and are left where boxes fly about. So now
/// and then some batches in a row are searched all the same, for rooms to be tried: less and less often.
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
    if (++held_batches_ == patience_) let_rooms_try();
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
    searches_left_ = least_searches;
  }
  void let_rooms_try() noexcept {
    forget();
    searches_left_ = least_searches + patience_ / 8;
    patience_ = patience_ < most_patience ? 2 * patience_ : patience_;
    held_batches_ = 0;
  }

  /// In these, rooms are made where boxes only tremble, and memory that many proxies took goes back.
  static constexpr unsigned least_searches = 12;
  static constexpr unsigned least_patience = 16, most_patience = 1024;

  bool are_known_ = true;  // at first there are none
  std::uint32_t moved_ = 0;
  std::uint32_t held_[most];
  unsigned held_batches_ = 0, patience_ = least_patience;  // since rooms were last let try, and at most
  unsigned searches_left_ = 0;                             // before this may take part
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
