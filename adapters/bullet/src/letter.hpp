// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/detail/float_environment.hpp>
#include <boxstream/world.hpp>

#include "precision.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// What the World has not been told yet: boxes that were set, in the arrays that its bulk calls take, and new proxies.
/// Many boxes set one after the other for a proxy cost the World one.
class Letter {
 public:
  using Box = BasicAabb<btScalar>;

  bool empty() const { return moved_ == 0 && created_.empty(); }

  /// Afterwards so many proxies can move without an exception.
  void make_room(std::size_t proxies) {
    const std::size_t wanted = moved_ + proxies;
    if (wanted <= ids_.size()) return;
    boxes_.resize(2 * wanted);
    ids_.resize(2 * wanted);
  }

  /// Its box and filter will be read on delivery.
  void create(Proxy& proxy) {
    proxy.letter_position = std::uint32_t(created_.size());
    created_.push_back(&proxy);
    proxy.told = proxy.filter();
  }

  void move(Proxy& proxy, const Box& box) {
    if (!proxy.id) return;
    if (!names(proxy)) {
      proxy.letter_position = moved_;
      ids_[moved_++] = proxy.id;
    }
    boxes_[proxy.letter_position] = box;
  }

  /// It is about to be destroyed. (The World leaves out boxes of ids that are stale.)
  void forget(const Proxy& proxy) {
    if (!proxy.id) created_[proxy.letter_position] = nullptr;
  }

  bool names(const Proxy& proxy) const {
    const std::uint32_t at = proxy.letter_position;
    return proxy.id ? at < moved_ && ids_[at] == proxy.id : at < created_.size() && created_[at] == &proxy;
  }

  /// Gives new proxies their ids, and is empty afterwards. `filter_for(proxy)` is what the World goes by.
  template <class FilterFor>
  void deliver(BasicWorld<btScalar>& world, btScalar margin, FilterFor&& filter_for) {
    if (margin != 0) grow(boxes_.data(), moved_, margin);
    world.move({ids_.data(), moved_}, {boxes_.data(), moved_});
    moved_ = 0;
    if (!created_.empty()) deliver_created(world, margin, filter_for);
  }

  /// What the World compares: the box grown by the margin, unless that could make an invalid box valid.
  static Box grown(const Box& box, btScalar margin) {
    const boxstream::detail::DefaultFloatEnvironment environment;
    return margin != 0 && is_valid(box) ? expanded(box, margin) : box;
  }

 private:
  static void grow(Box* boxes, std::size_t count, btScalar margin) {
    for (std::size_t i = 0; i < count; ++i) boxes[i] = grown(boxes[i], margin);
  }

  template <class FilterFor>
  void deliver_created(BasicWorld<btScalar>& world, btScalar margin, FilterFor&& filter_for) {
    created_.erase(std::remove(created_.begin(), created_.end(), nullptr), created_.end());
    const std::size_t count = created_.size();
    make_room(count);
    filters_.clear();
    users_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      Proxy& proxy = *created_[i];
      boxes_[i] = box_of(proxy.m_aabbMin, proxy.m_aabbMax);
      proxy.told = proxy.filter();
      filters_.push_back(filter_for(proxy));
      users_.push_back(reinterpret_cast<std::uintptr_t>(&proxy));
    }
    if (margin != 0) grow(boxes_.data(), count, margin);
    world.create({boxes_.data(), count}, filters_, {ids_.data(), count}, users_);
    for (std::size_t i = 0; i < count; ++i) created_[i]->id = ids_[i];
    created_.clear();
  }

  std::uint32_t moved_ = 0;  // so many of the next two
  std::vector<ProxyId> ids_;
  std::vector<Box> boxes_;
  std::vector<Proxy*> created_;

  // Scratch.
  std::vector<Filter> filters_;
  std::vector<std::uint64_t> users_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
