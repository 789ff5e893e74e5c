// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include <boxstream/bullet/precision.hpp>

#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Proxies in contiguous blocks: passes over all of them dominate frames with few changes. Addresses are stable; those
/// of dropped proxies are used again.
class ProxyPool {
 public:
  ProxyPool() = default;
  ProxyPool(const ProxyPool&) = delete;
  ProxyPool& operator=(const ProxyPool&) = delete;

  template <class... Arguments>
  Proxy* make(Arguments&&... arguments) {
    if (!free_) add_block();
    Place* const place = std::exchange(free_, free_->next);
    return ::new (static_cast<void*>(place)) Proxy(std::forward<Arguments>(arguments)...);
  }

  /// No proxy is left.
  void clear() noexcept {
    std::vector<std::unique_ptr<Place[]>>().swap(blocks_);
    free_ = nullptr;
    first_is_used_ = false;
  }

  void drop(Proxy& proxy) noexcept { free_ = ::new (static_cast<void*>(&proxy)) Place{free_}; }

 private:
  static_assert(std::is_trivially_destructible_v<Proxy>, "neither drop nor the end of the pool destroys proxies");

  union alignas(Proxy) Place {
    Place* next = nullptr;
    std::byte memory[sizeof(Proxy)];
  };

  void add_block() {
    if (!first_is_used_) {
      first_is_used_ = true;
      return add(first_, few);
    }
    constexpr std::size_t least = 8, most = 128;
    const std::size_t size = std::min(most, least << std::min<std::size_t>(blocks_.size(), 4));
    blocks_.push_back(std::make_unique<Place[]>(size));
    add(blocks_.back().get(), size);
  }
  /// In ascending order, so that proxies created one after the other lie so.
  void add(Place* block, std::size_t size) {
    for (std::size_t i = size; i-- > 0;) free_ = ::new (&block[i]) Place{free_};
  }

  static constexpr std::size_t few = 4;  // worlds of a few objects are made and dropped often
  Place first_[few];
  bool first_is_used_ = false;

  std::vector<std::unique_ptr<Place[]>> blocks_;
  Place* free_ = nullptr;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
