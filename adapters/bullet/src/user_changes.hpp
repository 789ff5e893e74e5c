// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/world.hpp>

#include "precision.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Which pairs users added to the own cache, or removed from it, since the last batch. The World forgets these pairs,
/// so that the batch decides about them anew. Of one that the World has begun in between, it knows better.
///
/// A log, in which the last entry of a pair counts: nothing is looked up when a user adds or removes.
class UserChanges {
 public:
  bool empty() const { return log_.empty(); }

  /// A user added or removed the pair.
  void by_user(const Proxy& low, const Proxy& high) { write({pair_key(low, high), 0, low.id, high.id, false}); }
  /// The pair began before the batch: what users did to it before does not count.
  void by_world(std::uint64_t key) {
    if (!log_.empty()) write({key, 0, {}, {}, true});
  }

  /// Calls `forget(a, b)` for what users changed since the last call. Ids may be stale or null.
  template <class Forget>
  void tell_new(Forget&& forget) {
    for (; told_ < log_.size(); ++told_) forget(log_[told_].a, log_[told_].b);
  }

  /// The same for all changes that count; these are the ones that the batch decides about.
  template <class Forget>
  void begin_batch(Forget&& forget) {
    keep_last_entries();
    log_.erase(std::remove_if(log_.begin(), log_.end(), [](const Entry& entry) { return entry.of_world; }), log_.end());
    told_ = 0;
    tell_new(forget);
    in_batch_ = log_.size();
  }
  /// Calls `visit(key)` for them, in order.
  template <class Visit>
  void for_each_in_batch(Visit&& visit) const {
    for (std::size_t i = 0; i < in_batch_; ++i) visit(log_[i].key);
  }
  void end_batch() {
    log_.erase(log_.begin(), log_.begin() + std::ptrdiff_t(in_batch_));
    told_ -= in_batch_;
    in_batch_ = 0;
  }

  bool contains(std::uint64_t key) const {
    return std::any_of(log_.begin(), log_.end(), [&](const Entry& entry) { return entry.key == key; });
  }
  /// Ids of proxies that are gone may come up again from now on; `in_use` are the others, in order.
  void forget_ids_not_in(const std::vector<std::int32_t>& in_use) {
    const auto is_gone = [&](std::uint64_t id) {
      return !std::binary_search(in_use.begin(), in_use.end(), std::int32_t(id & 0xffffffffu));
    };
    log_.erase(std::remove_if(log_.begin(), log_.end(),
                              [&](const Entry& entry) { return is_gone(entry.key >> 32) || is_gone(entry.key); }),
               log_.end());
    told_ = 0;  // to be told twice does no harm
  }
  void clear() {
    log_.clear();
    told_ = in_batch_ = 0;
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::size_t time;
    ProxyId a, b;
    bool of_world;
  };

  void write(Entry entry) {
    // Adding and removing, over and over without a batch, must not take ever more memory.
    if (log_.size() == log_.capacity() && in_batch_ == 0) keep_last_entries();
    entry.time = log_.size();
    log_.push_back(entry);
  }

  void keep_last_entries() {
    std::sort(log_.begin(), log_.end(),
              [](const Entry& x, const Entry& y) { return x.key != y.key ? x.key < y.key : x.time < y.time; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < log_.size(); ++i)
      if (i + 1 == log_.size() || log_[i + 1].key != log_[i].key) log_[kept++] = log_[i];
    log_.resize(kept);
    for (std::size_t i = 0; i < kept; ++i) log_[i].time = i;
    told_ = 0;
  }

  std::vector<Entry> log_;
  std::size_t told_ = 0;      // so many entries
  std::size_t in_batch_ = 0;  // the first so many entries, in order of keys
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
