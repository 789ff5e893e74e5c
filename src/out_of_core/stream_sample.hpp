// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "out_of_core/buffers.hpp"
#include "out_of_core/hash.hpp"
#include "out_of_core/regions.hpp"

namespace boxstream::detail {

/// Some of the boxes of a stream whose length is not known: those whose positions have small hashes. A function of the
/// stream; no period in it is seen.
template <class S>
class StreamSample {
 public:
  explicit StreamSample(std::size_t most) : most_(most) {}

  void add(const BasicAabb<S>& box) {
    const std::uint64_t hash = hash_of(position_++);
    if (hash > highest_) return;
    append(boxes_, {hash, KeyBox<S>(box)}, most_ + 1);
    if (boxes_.size() > most_) halve();
  }

  std::size_t size() const { return boxes_.size(); }
  std::vector<KeyBox<S>> boxes() const {
    std::vector<KeyBox<S>> boxes;
    boxes.reserve(boxes_.size());
    for (const auto& [hash, box] : boxes_) boxes.push_back(box);
    return boxes;
  }

 private:
  void halve() {
    highest_ /= 2;
    boxes_.erase(std::remove_if(boxes_.begin(), boxes_.end(), [&](const auto& b) { return b.first > highest_; }),
                 boxes_.end());
  }

  std::size_t most_;
  std::uint64_t position_ = 0;
  std::uint64_t highest_ = UINT64_MAX;
  std::vector<std::pair<std::uint64_t, KeyBox<S>>> boxes_;
};

}  // namespace boxstream::detail
