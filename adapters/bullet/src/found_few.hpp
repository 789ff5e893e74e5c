// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <boxstream/bullet/precision.hpp>

#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// The proxies found by a query where there are so few that a look at each takes less than a call of the World, which
/// need not hear of pending changes then. As with Found, callbacks may query again, and create and destroy proxies.
class FoundFew {
 public:
  using Proxies = std::vector<Proxy*>;

  static bool can_look(const Proxies& live) { return live.size() <= most; }

  /// `created` counts proxies, ever. Both are what they are now whenever this uses them.
  FoundFew(const Proxies& live, const std::uint64_t& created)
      : live_(live), created_(created), were_live_(live.size()), were_created_(created) {}

  /// Adds those for which `is_found(proxy)` is true, in the order of their creation.
  template <class IsFound>
  void look(IsFound&& is_found) {
    for (const Proxy* proxy : live_)
      if (is_found(*proxy)) add(*proxy);
  }

  template <class Callback>
  void report(Callback& callback) const {
    for (std::size_t i = 0; i < size_; ++i)
      if (is_live(found_[i])) callback.process(found_[i].proxy);
  }

 private:
  static constexpr std::size_t most = 12;

  struct Place {
    const Proxy* proxy;
    std::uint64_t created;
  };

  void add(const Proxy& proxy) {
    Place* place = found_ + size_++;
    for (; place != found_ && place[-1].created > proxy.created; --place) *place = place[-1];
    *place = {&proxy, proxy.created};
  }

  /// Memory of a proxy that is gone is used again.
  bool is_live(const Place& place) const {
    if (live_.size() == were_live_ && created_ == were_created_) return true;
    return std::any_of(live_.begin(), live_.end(),
                       [&](const Proxy* proxy) { return proxy == place.proxy && proxy->created == place.created; });
  }

  const Proxies& live_;
  const std::uint64_t& created_;
  const std::size_t were_live_;
  const std::uint64_t were_created_;
  std::size_t size_ = 0;
  Place found_[most];
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
