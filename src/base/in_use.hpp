// SPDX-License-Identifier: MIT
#pragma once

#ifndef NDEBUG
#include <atomic>
#include <cassert>
#include <thread>
#endif

namespace boxstream::detail {

/// Debug builds assert that an object is not changed while another use of it goes on: from a second thread, or from
/// inside one of its own callbacks. Reading inside the callbacks of a change is allowed. Detection is best effort: two
/// uses that happen not to overlap pass. Release builds do nothing.
class InUse {
 public:
#ifdef NDEBUG
  struct Change {
    explicit Change(InUse&) {}
    ~Change() {}
  };
  struct Read {
    explicit Read(const InUse&) {}
    ~Read() {}
  };
#else
  class Change {
   public:
    explicit Change(InUse& object) : object_(object) {
      std::thread::id none;
      const bool alone = object_.changer_.compare_exchange_strong(none, std::this_thread::get_id());
      assert(alone && object_.readers_.load() == 0 && "boxstream: changed by two at once, or inside a callback");
    }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;
    ~Change() { object_.changer_ = std::thread::id(); }

   private:
    InUse& object_;
  };

  class Read {
   public:
    explicit Read(const InUse& object) : object_(object) {
      ++object_.readers_;
      const std::thread::id changer = object_.changer_;
      assert((changer == std::thread::id() || changer == std::this_thread::get_id()) &&
             "boxstream: read while another thread changes it");
    }
    Read(const Read&) = delete;
    Read& operator=(const Read&) = delete;
    ~Read() { --object_.readers_; }

   private:
    const InUse& object_;
  };

 private:
  mutable std::atomic<int> readers_{0};
  std::atomic<std::thread::id> changer_{};
#endif
};

}  // namespace boxstream::detail
