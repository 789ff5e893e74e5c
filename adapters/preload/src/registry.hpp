// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>

namespace boxstream::preload {

/// What stands in for each object of an engine, by the object's address. Any number of threads may look up, add and
/// remove at once, of different objects. A thread that asks for the same object again pays for a compare.
template <class Stand>
class Registry {
 public:
  Stand* find(const void* object) const {
    thread_local struct {
      const Registry* registry = nullptr;
      const void* object = nullptr;
      std::uint64_t generation = 0;
      Stand* stand = nullptr;
    } last;
    const std::uint64_t generation = generation_.load(std::memory_order_acquire);
    if (last.object == object && last.generation == generation && last.registry == this) return last.stand;
    std::shared_lock lock(mutex_);
    const auto found = stands_.find(object);
    last = {this, object, generation, found == stands_.end() ? nullptr : found->second.get()};
    return last.stand;
  }

  Stand& add(const void* object, std::unique_ptr<Stand> stand) {
    std::unique_lock lock(mutex_);
    Stand& added = *(stands_[object] = std::move(stand));
    generation_.fetch_add(1, std::memory_order_release);
    return added;
  }

  std::unique_ptr<Stand> remove(const void* object) {
    std::unique_lock lock(mutex_);
    const auto found = stands_.find(object);
    if (found == stands_.end()) return nullptr;
    auto stand = std::move(found->second);
    stands_.erase(found);
    generation_.fetch_add(1, std::memory_order_release);
    return stand;
  }

 private:
  mutable std::shared_mutex mutex_;
  std::unordered_map<const void*, std::unique_ptr<Stand>> stands_;
  std::atomic<std::uint64_t> generation_{1};
};

}  // namespace boxstream::preload
