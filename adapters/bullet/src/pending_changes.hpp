// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/world.hpp>

#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Changes that the World does not have yet: boxes, in the arrays that its bulk calls take, and new proxies. Of several
/// boxes set for a proxy the World gets the last one.
class PendingChanges {
 public:
  using Box = BasicAabb<btScalar>;

  bool empty() const { return moved_ == 0 && created_.empty(); }
  bool are_created() const { return !created_.empty(); }
  /// With those of proxies that are gone.
  std::size_t size() const { return moved_ + created_.size(); }

  /// Makes room for moves of `proxies` proxies, which cannot throw then.
  void reserve(std::size_t proxies) {
    const std::size_t wanted = moved_ + proxies;
    if (wanted <= ids_.size()) return;
    const std::size_t room = std::max<std::size_t>(2 * wanted, 8);
    boxes_.resize(room);
    ids_.resize(room);
    if (created_.capacity() == 0) created_.reserve(8);
  }

  /// While it is empty: leaves room for moves of `proxies` proxies.
  void shrink_to_fit(std::size_t proxies) {
    if (ids_.size() > proxies) {
      boxes_.resize(proxies);
      ids_.resize(proxies);
    }
    const auto fit = [](auto&... vectors) { (vectors.shrink_to_fit(), ...); };
    std::vector<Filter>().swap(filters_);
    std::vector<std::uint64_t>().swap(users_);
    fit(boxes_, ids_, created_);
  }

  /// Box and filter are read by `flush`.
  void create(Proxy& proxy) {
    // Coming and going without a flush must not grow the list without bound.
    if (created_.size() == created_.capacity()) drop_discarded();
    proxy.pending_index = std::uint32_t(created_.size());
    created_.push_back(&proxy);
    proxy.world_filter = proxy.filter();
  }

  /// `box` is that of the World.
  void move(Proxy& proxy, const Box& box) {
    if (!proxy.id) return;
    if (!contains(proxy)) {
      proxy.pending_index = moved_;
      ids_[moved_++] = proxy.id;
    }
    boxes_[proxy.pending_index] = box;
  }

  /// For a proxy that is about to be destroyed. (The World ignores boxes of stale ids.)
  void discard(const Proxy& proxy) {
    if (!proxy.id) created_[proxy.pending_index] = nullptr;
  }

  bool contains(const Proxy& proxy) const {
    const std::uint32_t at = proxy.pending_index;
    return proxy.id ? at < moved_ && ids_[at] == proxy.id : at < created_.size() && created_[at] == &proxy;
  }

  /// Applies all changes to the World and sets the ids of new proxies. `filter_for(proxy)` is the filter in the World,
  /// asked for while `world_filter` is still that of when the proxy came.
  template <class FilterFor>
  void flush(BasicWorld<btScalar>& world, FilterFor&& filter_for) {
    world.move({ids_.data(), moved_}, {boxes_.data(), moved_});
    last_moved_ = moved_;
    moved_ = 0;
    if (!created_.empty()) flush_created(world, filter_for);
  }

  /// What the last `flush` has passed on, if that were moves of some proxies only.
  Span<const ProxyId> last_moved() const {
    constexpr std::uint32_t some = 8;
    return {ids_.data(), last_moved_ <= some ? last_moved_ : 0};
  }

  /// The box in the World: grown by the margin, unless it is invalid.
  static Box grown(const Box& box, btScalar margin) {
    if (margin == 0) return box;
    const boxstream::detail::DefaultFloatEnvironment environment;
    return is_valid(box) ? expanded(box, margin) : box;
  }

 private:
  void drop_discarded() {
    std::uint32_t kept = 0;
    for (Proxy* proxy : created_) {
      if (proxy == nullptr) continue;
      proxy->pending_index = kept;
      created_[kept++] = proxy;
    }
    created_.resize(kept);
    created_.reserve(2 * std::size_t{kept} + 8);  // so that it is not done again soon
  }

  template <class FilterFor>
  void flush_created(BasicWorld<btScalar>& world, FilterFor&& filter_for) {
    last_moved_ = 0;
    created_.erase(std::remove(created_.begin(), created_.end(), nullptr), created_.end());
    const std::size_t count = created_.size();
    reserve(count);
    constexpr std::size_t few = 16;  // which need no scratch
    Filter few_filters[few];
    std::uint64_t few_users[few];
    if (count > few) {
      filters_.resize(count);
      users_.resize(count);
    }
    const Span<Filter> filters(count > few ? filters_.data() : few_filters, count);
    const Span<std::uint64_t> users(count > few ? users_.data() : few_users, count);
    for (std::size_t i = 0; i < count; ++i) {
      Proxy& proxy = *created_[i];
      boxes_[i] = grown(box_of(proxy.m_aabbMin, proxy.m_aabbMax), proxy.margin);
      filters[i] = filter_for(proxy);
      proxy.world_filter = proxy.filter();
      users[i] = reinterpret_cast<std::uintptr_t>(&proxy);
    }
    world.create({boxes_.data(), count}, filters, {ids_.data(), count}, users);
    for (std::size_t i = 0; i < count; ++i) created_[i]->id = ids_[i];
    created_.clear();
  }

  std::uint32_t moved_ = 0;  // elements used of the next two
  std::uint32_t last_moved_ = 0;
  std::vector<ProxyId> ids_;
  std::vector<Box> boxes_;
  std::vector<Proxy*> created_;

  // Scratch.
  std::vector<Filter> filters_;
  std::vector<std::uint64_t> users_;
};

/// Larger than the box of the proxy, by what is for pairs and rays only.
inline PendingChanges::Box box_in_world(const Proxy& proxy) {
  return PendingChanges::grown(box_of(proxy.m_aabbMin, proxy.m_aabbMax), proxy.margin);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
