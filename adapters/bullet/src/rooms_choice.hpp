// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <boxstream/bullet/precision.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// What it takes to follow rooms of all proxies, or to do without, in units of one watched pair, which is 12 ns in a
/// world whose solver has emptied the caches.
namespace room_prices {

using Price = std::uint64_t;

/// To pass all boxes on and search for what has changed, if all have moved.
inline Price search(std::size_t proxies) {
  return 8 * (Price{proxies} + 64);
}
/// Of boxes that have left their rooms, and of those among them that have left their fat boxes, too.
inline Price exits(std::size_t count) {
  return 160 * Price{count};
}
inline Price strays(std::size_t count) {
  return 1024 * Price{count};
}
inline Price opening(std::size_t proxies) {
  return 128 * Price{proxies};
}
/// What rooms take, some 300 bytes a proxy, stays in caches of 1 to 2 MB. In a pile of 8000 a watched pair takes twice
/// as long and a box that has left three times, so that nothing is saved, and to open them takes a frame that is seen.
inline bool fit_caches(std::size_t proxies) {
  return proxies <= 4096;
}

}  // namespace room_prices

/// Chooses, batch by batch, whether rooms of all proxies are worth it. They are opened when batches have been calm for
/// a while, and closed where to follow them costs more than to search. Where they have not saved as much as it took to
/// open them, they are opened less and less often.
class RoomsChoice {
 public:
  using Price = room_prices::Price;

  /// After a batch that was searched: true if it is time to open them.
  bool opens(std::size_t proxies, bool is_calm) {
    constexpr unsigned least = 10;  // until then memory of the search is given back
    calm_ = is_calm && room_prices::fit_caches(proxies) ? calm_ + 1 : 0;
    if (calm_ < least << failures_) return false;
    calm_ = 0;
    return true;
  }
  void opened(std::size_t proxies) {
    gained_ = -std::int64_t(room_prices::opening(proxies));
    load_ = 0;
  }

  /// What a batch with rooms has to follow, and what it takes otherwise. False if they have to be closed, by the mean
  /// of eight batches.
  bool go_on(std::size_t watched, std::size_t exits, std::size_t strays, Price search) {
    const Price price = Price{watched} + room_prices::exits(exits) + room_prices::strays(strays);
    load_ += price - load_ / 8;
    gained_ += std::int64_t(search) - std::int64_t(price);
    return load_ <= 8 * search;
  }
  void closed() {
    constexpr unsigned most = 7;
    failures_ = gained_ < 0 ? std::min(failures_ + 1, most) : 0;
    calm_ = 0;
  }

 private:
  unsigned calm_ = 0;  // batches in a row, in which many boxes moved and few pairs changed
  unsigned failures_ = 0;
  Price load_ = 0;  // of about eight batches
  std::int64_t gained_ = 0;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
