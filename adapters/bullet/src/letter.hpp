// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/world.hpp>

#include "precision.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Boxes on their way to the World, in the arrays that its bulk calls take.
class Letter {
 public:
  using Box = BasicAabb<btScalar>;

  void move(const Proxy& proxy, const Box& box) {
    moved_ids_.push_back(proxy.id);
    moved_boxes_.push_back(box);
  }

  void create(Proxy& proxy, const Box& box, Filter filter) {
    created_.push_back(&proxy);
    created_boxes_.push_back(box);
    created_filters_.push_back(filter);
    created_users_.push_back(reinterpret_cast<std::uintptr_t>(&proxy));
  }

  /// Gives created proxies their ids, and is empty afterwards.
  void deliver(BasicWorld<btScalar>& world) {
    world.move(moved_ids_, moved_boxes_);
    moved_ids_.clear();
    moved_boxes_.clear();
    if (created_.empty()) return;
    created_ids_.resize(created_.size());
    world.create(created_boxes_, created_filters_, created_ids_, created_users_);
    for (std::size_t i = 0; i < created_.size(); ++i) created_[i]->id = created_ids_[i];
    created_.clear();
    created_boxes_.clear();
    created_filters_.clear();
    created_users_.clear();
  }

 private:
  std::vector<ProxyId> moved_ids_;
  std::vector<Box> moved_boxes_;
  std::vector<Proxy*> created_;
  std::vector<Box> created_boxes_;
  std::vector<Filter> created_filters_;
  std::vector<std::uint64_t> created_users_;
  std::vector<ProxyId> created_ids_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
