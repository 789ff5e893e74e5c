// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/bullet/precision.hpp>

#include "pair_store.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Of few proxies, which pairs are held, a bit for each. A batch in which the boxes that have moved touch what they are
/// held with, and nothing else, is over then. The World hears of their boxes when there is more to do, or a query.
///
/// Rooms (see ProxyRooms) take no look at other boxes, but have to be made. So batches are searched now and then all
/// the same, less and less often, for rooms to be tried.
class FewVerdicts {
 public:
  using Proxies = std::vector<Proxy*>;

  static constexpr std::size_t most = 64;

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

  /// True if nothing begins or ends by what has moved since this was last asked, or learned.
  bool hold(const Proxies& live);

  void validate(const Proxies& live, PairStore& pairs) const;

 private:
  static std::uint64_t bit(std::uint32_t position) { return std::uint64_t{1} << position % most; }
  bool are_held(std::uint32_t a, std::uint32_t b) const { return (held_[a] & bit(b)) != 0; }
  void note_many() noexcept {
    forget();
    searches_left_ = searches_after_many;
  }

  static constexpr unsigned least_patience = 4, most_patience = 64;
  /// In these, memory that many proxies took goes back.
  static constexpr unsigned searches_after_many = 12;

  bool are_known_ = true;  // at first there are none
  std::uint64_t moved_ = 0;
  std::uint64_t held_[most];
  unsigned held_batches_ = 0, patience_ = least_patience;  // since the last search, and at most
  unsigned searches_left_ = 0;                             // before this may take part
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
