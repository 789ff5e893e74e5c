// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <boxstream/bullet/precision.hpp>

#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// 1, 2, 3 ... as btDbvtBroadphase counts. After the last number that m_uniqueId can hold it starts again from 1 and
/// leaves out those in use. So a freed id is used again in a later round only.
class UniqueIds {
 public:
#ifdef BOXSTREAM_BULLET_LAST_ID
  static constexpr std::int32_t last = BOXSTREAM_BULLET_LAST_ID;  // for tests, which cannot count to 2^31
#else
  static constexpr std::int32_t last = std::numeric_limits<std::int32_t>::max();
#endif

  /// `live` are the proxies there are. Throws std::length_error if all are in use.
  std::int32_t next(const std::vector<Proxy*>& live) {
    while (true) {
      if (latest_ == last) start_again(live);
      ++latest_;
      if (passed_ == in_use_.size() || in_use_[passed_] != latest_) return latest_;
      ++passed_;
    }
  }

  void reset() {
    *this = UniqueIds();
  }

 private:
  void start_again(const std::vector<Proxy*>& live) {
    if (live.size() >= std::size_t(last)) throw std::length_error("boxstream: more proxies than ids");
    in_use_.clear();
    for (const Proxy* proxy : live) in_use_.push_back(proxy->m_uniqueId);
    std::sort(in_use_.begin(), in_use_.end());
    passed_ = 0;
    latest_ = 0;
  }

  std::int32_t latest_ = 0;
  std::vector<std::int32_t> in_use_;  // when this round began
  std::size_t passed_ = 0;            // of these
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
