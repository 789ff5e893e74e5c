// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <boxstream/span.hpp>

namespace boxstream::papers {

/// The binary structure whose parts are built a little at each insertion (section 6.3): no insertion waits for one.
///
/// Two parts of 2^i objects are built into one of 2^(i+1) during the next 2^(i+1) insertions, and go on answering until
/// these are over. As two more come to level i in just that time, a level builds one part at a time and has at most
/// three complete ones; an insertion does a 2^-i th of the work of each part that is being built, O(log n B(n) / n) in
/// all.
///
/// `Builder` builds a `Static` from two spans of items with run(work), in at most work_of(n) units (see KdBuilder).
template <class Static, class Builder>
class SteppedLevels {
 public:
  using Item = typename Static::Item;
  using Part = std::shared_ptr<const Static>;  // complete: shared with a build that copies its items meanwhile

  /// One of the parts to start from: 2^level objects, at most one for each level, before anything is inserted.
  void start_with(std::size_t level, Static part) {
    at(level).parts.push_back(std::make_shared<const Static>(std::move(part)));
  }

  /// Returns the units of work done.
  std::uint64_t insert(Item item) {
    std::uint64_t work = 1;
    // By index: `at` may move the levels.
    for (std::size_t i = 0; i < levels_.size(); ++i) work += go_on(i);
    at(0).parts.push_back(std::make_shared<const Static>(std::vector<Item>{item}));
    for (std::size_t i = 0; i < levels_.size(); ++i) begin(i);
    return work;
  }

  /// Complete parts, which have each object once.
  template <class Visit>
  void for_each_part(Visit&& visit) const {
    for (const Level& level : levels_)
      for (const Part& part : level.parts) visit(part);
  }

  std::size_t level_count() const { return levels_.size(); }
  std::size_t parts_at(std::size_t level) const { return levels_[level].parts.size(); }

 private:
  struct Level {
    std::vector<Part> parts;
    std::optional<Builder> builder;  // of the first two
    std::size_t insertions_left = 0;
  };

  Level& at(std::size_t level) {
    if (levels_.size() <= level) levels_.resize(level + 1);
    return levels_[level];
  }

  static std::size_t insertions_for(std::size_t level) { return std::size_t{2} << level; }

  void begin(std::size_t i) {
    Level& level = levels_[i];
    if (level.builder || level.parts.size() < 2) return;
    level.builder.emplace(Span<const Item>(level.parts[0]->items()), Span<const Item>(level.parts[1]->items()));
    level.insertions_left = insertions_for(i);
  }

  std::uint64_t go_on(std::size_t i) {
    Level& level = levels_[i];
    if (!level.builder) return 0;
    const std::size_t insertions = insertions_for(i);
    const std::uint64_t work = level.builder->run((Builder::work_of(insertions) + insertions - 1) / insertions);
    if (--level.insertions_left != 0) return work;
    auto part = std::make_shared<const Static>(level.builder->take());
    level.builder.reset();
    level.parts.erase(level.parts.begin(), level.parts.begin() + 2);
    at(i + 1).parts.push_back(std::move(part));
    return work;
  }

  std::vector<Level> levels_;
};

}  // namespace boxstream::papers
