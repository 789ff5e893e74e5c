// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/world.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Free list of lists of one broad-phase's queries, kept for their memory.
class SpareLists {
 public:
  /// An empty list.
  std::vector<ProxyId> take() {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::vector<ProxyId> list = std::move(idle_.back());
      idle_.pop_back();
      return list;
    }
    idle_.reserve(++made_);  // so that giving back cannot fail
    return {};
  }

  void give_back(std::vector<ProxyId> list) noexcept {
    list.clear();
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(list));
  }

  /// While no query runs.
  void clear() noexcept {
    std::vector<std::vector<ProxyId>>().swap(idle_);
    made_ = 0;
  }

 private:
  std::mutex mutex_;
  std::vector<std::vector<ProxyId>> idle_;
  std::size_t made_ = 0;
};

/// The proxies found by one query. They are collected before the first callback, so that callbacks run outside of the
/// World and may query again. Nothing is shared with other queries, on other threads, inside this one, or on other
/// fibres.
class Found {
 public:
  explicit Found(SpareLists& spare) : spare_(spare) {}
  Found(const Found&) = delete;
  Found& operator=(const Found&) = delete;
  ~Found() {
    if (size_ > few) spare_.give_back(std::move(more_));
  }

  void add(ProxyId id) {
    if (size_ < few)
      few_[size_++] = id;
    else
      add_to_more(id);
  }

  /// `resolve(id)` gives the proxy or null.
  template <class Callback, class Resolve>
  void report(Callback& callback, Resolve&& resolve) const {
    const auto pass_on = [&](ProxyId id) {
      if (const auto* proxy = resolve(id)) callback.process(proxy);
    };
    for (std::size_t i = 0; i < size_ && i < few; ++i) pass_on(few_[i]);
    for (const ProxyId id : more_) pass_on(id);
  }

 private:
  void add_to_more(ProxyId id) {
    if (size_ == few) {
      more_ = spare_.take();
      ++size_;
    }
    more_.push_back(id);
  }

  static constexpr std::size_t few = 32;  // on the stack; most queries find no more

  SpareLists& spare_;
  std::size_t size_ = 0;  // of few_; more than that if there are more
  union {
    ProxyId few_[few];  // without the cost of making them null first
  };
  std::vector<ProxyId> more_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
