// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "papers/structures/marks.hpp"

namespace boxstream::papers {

/// A static structure made dynamic, sections 6.2.1 to 6.2.3: the objects are in structures V_i of 2^i each, one for
/// each bit of their number. An object more is one structure more, of itself and all V_0 .. V_(j-1), where V_j is the
/// first that is missing: as a binary number counts up. Objects are deleted weakly, and when half of all are, what is
/// left is built anew.
///
/// Amortised, for objects among which a query can be answered by parts: insertion O(log n B(n) / n), deletion
/// O(B(n) / n), query O(log n Q(n)).
///
/// `Static` is built by Static(std::vector<Item>), has query(query, visit(item)) and items(), and moves its Item's
/// `number` about. One operation may take O(B(n)); see WorstCaseStructure.
template <class Static>
class BinaryStructure {
 public:
  using Item = typename Static::Item;
  using Query = typename Static::Query;
  using Handle = Marks::Handle;

  BinaryStructure() = default;

  /// items[i] gets the handle i.
  explicit BinaryStructure(std::vector<Item> items) {
    for (Item& item : items) item.number = marks_.add(item.number);
    build(std::move(items));
  }

  Handle insert(Item item) {
    const Handle handle = marks_.add(item.number);
    item.number = handle;
    std::vector<Item> items{item};
    std::size_t j = 0;
    for (; j < parts_.size() && !parts_[j].items().empty(); ++j) {
      items.insert(items.end(), parts_[j].items().begin(), parts_[j].items().end());
      parts_[j] = Static();
    }
    if (j == parts_.size()) parts_.emplace_back();
    ++stored_;
    set(j, std::move(items));
    return handle;
  }

  /// False if there is no such object.
  bool erase(Handle handle) {
    if (!marks_.kill(handle)) return false;
    if (2 * marks_.live() <= stored_) rebuild();
    return true;
  }

  /// Calls `visit(number)` for the answer, in any order.
  template <class Visit>
  void query(const Query& wanted, Visit&& visit) const {
    for (const Static& part : parts_)
      part.query(wanted, [&](const Item& item) {
        if (marks_.alive(item.number)) visit(marks_.number(item.number));
      });
  }

  std::size_t size() const { return marks_.live(); }
  /// With those deleted weakly.
  std::size_t stored() const { return stored_; }
  /// V_i, empty where the bit is 0.
  const std::vector<Static>& parts() const { return parts_; }
  /// Objects that were built into a structure, each time that they were.
  std::uint64_t built() const { return built_; }

 private:
  void set(std::size_t i, std::vector<Item> items) {
    built_ += items.size();
    parts_[i] = Static(std::move(items));
  }

  void build(std::vector<Item> items) {
    parts_.clear();
    stored_ = items.size();
    for (std::size_t i = 0; stored_ >> i != 0; ++i) {
      parts_.emplace_back();
      const std::size_t count = stored_ & (std::size_t{1} << i);
      if (count == 0) continue;
      const auto first = items.end() - static_cast<std::ptrdiff_t>(count);
      set(i, std::vector<Item>(first, items.end()));
      items.erase(first, items.end());
    }
  }

  void rebuild() {
    std::vector<Item> items;
    items.reserve(marks_.live());
    for (const Static& part : parts_)
      for (const Item& item : part.items())
        if (marks_.alive(item.number)) items.push_back(item);
    marks_.reuse(marks_.take_killed());
    build(std::move(items));
  }

  Marks marks_;
  std::vector<Static> parts_;
  std::size_t stored_ = 0;
  std::uint64_t built_ = 0;
};

}  // namespace boxstream::papers
