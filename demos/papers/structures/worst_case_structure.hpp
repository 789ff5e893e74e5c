// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "papers/structures/marks.hpp"

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

/// A static structure made dynamic with bounds on every single operation, section 6.3 and theorem 13. The paper gives
/// the result; this is how it comes about here.
///
/// Insertion: SteppedLevels. Deletion: weak; once a quarter of the stored objects is deleted, a second structure of the
/// live ones is made beside the first one, a little at each operation, and takes its place before half of them are:
/// within n / 4 operations, half of them for building, half for what was inserted meanwhile, two objects at a time.
/// Objects deleted meanwhile need no care, because marks are for both.
///
/// Growing tables of marks is amortised; counted is the work on structures.
template <class Static, class Builder>
class WorstCaseStructure {
 public:
  using Item = typename Static::Item;
  using Query = typename Static::Query;
  using Handle = Marks::Handle;
  using Levels = SteppedLevels<Static, Builder>;

  WorstCaseStructure() = default;

  /// items[i] gets the handle i. Built at once.
  explicit WorstCaseStructure(std::vector<Item> items) : stored_(items.size()) {
    for (Item& item : items) item.number = marks_.add(item.number);
    for (std::size_t level = 0; stored_ >> level != 0; ++level) {
      const std::size_t count = stored_ & (std::size_t{1} << level);
      if (count == 0) continue;
      const auto first = items.end() - static_cast<std::ptrdiff_t>(count);
      levels_.start_with(level, Static(std::vector<Item>(first, items.end())));
      items.erase(first, items.end());
    }
  }

  Handle insert(Item item) {
    const Handle handle = marks_.add(item.number);
    item.number = handle;
    work_ = levels_.insert(item);
    ++stored_;
    if (rebuild_) rebuild_->waiting.push_back(item);
    go_on();
    return handle;
  }

  /// False if there is no such object.
  bool erase(Handle handle) {
    if (!marks_.kill(handle)) return false;
    work_ = 1;
    if (!rebuild_ && 4 * (stored_ - marks_.live()) >= stored_) begin();
    go_on();
    return true;
  }

  /// Calls `visit(number)` for the answer, in any order.
  template <class Visit>
  void query(const Query& wanted, Visit&& visit) const {
    levels_.for_each_part([&](const typename Levels::Part& part) {
      part->query(wanted, [&](const Item& item) {
        if (marks_.alive(item.number)) visit(marks_.number(item.number));
      });
    });
  }

  std::size_t size() const { return marks_.live(); }
  /// With those deleted weakly.
  std::size_t stored() const { return stored_; }
  const Levels& levels() const { return levels_; }
  /// Units of work that the last insertion or deletion did on structures.
  std::uint64_t last_work() const { return work_; }

 private:
  /// The second structure in the making.
  struct Rebuild {
    std::vector<typename Levels::Part> sources;  // of the first one, at the beginning
    std::size_t source = 0, at = 0;              // the next item to be looked at
    std::vector<Item> items;                     // live ones among them
    std::optional<Builder> builder;              // of the last `building` of them
    std::size_t level = 0, building = 0;
    Levels levels;
    std::size_t stored = 0;
    std::uint64_t work_an_operation = 0;
    std::vector<Item> waiting;  // inserted since the beginning
    std::size_t next_waiting = 0;
    std::vector<Handle> killed;  // before the beginning, so that they are not in it
  };

  void begin() {
    Rebuild& r = rebuild_.emplace();
    levels_.for_each_part([&](const auto& part) { r.sources.push_back(part); });
    r.killed = marks_.take_killed();
    const std::size_t live = marks_.live();
    r.items.reserve(live);
    const std::uint64_t work = stored_ + live + Builder::work_of(live);
    const std::size_t operations = std::max<std::size_t>(1, live / 8);
    r.work_an_operation = (work + operations - 1) / operations;
  }

  void go_on() {
    if (!rebuild_) return;
    Rebuild& r = *rebuild_;
    for (std::uint64_t left = r.work_an_operation; left != 0 && !is_built(r);) {
      const std::uint64_t done = build(r, left);
      left -= done;
      work_ += done;
    }
    if (!is_built(r)) return;
    for (int i = 0; i < 2 && r.next_waiting < r.waiting.size(); ++i) {
      const Item& item = r.waiting[r.next_waiting++];
      if (!marks_.alive(item.number)) continue;
      work_ += r.levels.insert(item);
      ++r.stored;
    }
    if (r.next_waiting < r.waiting.size()) return;
    levels_ = std::move(r.levels);
    stored_ = r.stored;
    marks_.reuse(std::move(r.killed));
    rebuild_.reset();
  }

  static bool is_built(const Rebuild& r) { return r.source == r.sources.size() && r.items.empty() && !r.builder; }

  /// At most `work` units, at least one.
  std::uint64_t build(Rebuild& r, std::uint64_t work) {
    if (r.source < r.sources.size()) {
      const Span<const Item> from = r.sources[r.source]->items();
      if (marks_.alive(from[r.at].number)) r.items.push_back(from[r.at]);
      if (++r.at == from.size()) {
        r.at = 0;
        ++r.source;
      }
      r.stored = r.items.size();
      return 1;
    }
    if (!r.builder) {
      while ((r.stored >> r.level & 1) == 0) ++r.level;
      r.building = std::size_t{1} << r.level;
      r.builder.emplace(Span<const Item>(r.items).subspan(r.items.size() - r.building, r.building));
    }
    const std::uint64_t done = r.builder->run(work);
    if (r.builder->finished()) {
      r.levels.start_with(r.level++, r.builder->take());
      r.builder.reset();
      r.items.resize(r.items.size() - r.building);
    }
    return std::max<std::uint64_t>(done, 1);
  }

  Marks marks_;
  Levels levels_;
  std::size_t stored_ = 0;
  std::optional<Rebuild> rebuild_;
  std::uint64_t work_ = 0;
};

}  // namespace boxstream::papers
