// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "papers/volumes/hierarchy.hpp"
#include "papers/volumes/recursion.hpp"

namespace boxstream::papers::volumes {

/// Incremental traversal, section 5.2: keeps the bottom slice of the recursion tree, the pairs at which a traversal
/// ends, because they are clear of each other or leaves. The next search starts there, and goes down where pairs no
/// longer are clear, and up where all children of a pair are and the pair itself is, too.
///
/// `a` and `b` are kept by reference, may be the same, and are to be refitted between steps as objects move; their
/// trees must stay. Any slice yields all pairs, so the result does not depend on how far objects moved; only the time
/// does. Memory: 12 bytes for each pair of the slice, twice.
///
/// What it can save is bounded: it visits the slice, and a traversal from the root visits the slice and all above it,
/// which is less than half of all where pairs have two children, and less than a quarter where they have four.
template <Volume V>
class Front {
 public:
  Front(const Hierarchy<V>& a, const Hierarchy<V>& b, Descent descent)
      : a_(a), b_(b), recursion_(a.tree(), b.tree(), descent) {
    if (!recursion_.is_empty()) slice_.push_back({recursion_.root(), false, false});
  }

  std::size_t size() const { return slice_.size(); }

  /// As `traverse`.
  template <class Meets, class Found>
  void step(const Meets& meets, const Found& found, Counts& counts) {
    next_.clear();
    for (const Entry& entry : slice_) {
      if (are_clear(entry.pair, counts)) {
        add_clear({entry.pair, true, false}, counts);
        continue;
      }
      descend(entry.pair, meets, found, counts);
    }
    std::swap(slice_, next_);
  }

 private:
  struct Entry {
    NodePair pair;
    bool clear;    ///< of each other
    bool entered;  ///< in this step, from above: its parent is known not to be clear

    bool is_kept_clear() const { return clear && !entered; }
  };

  bool are_clear(NodePair pair, Counts& counts) const {
    ++counts.volume_tests;
    return !overlap(a_.volume(pair.a), b_.volume(pair.b));
  }

  /// Beneath a pair that is not clear.
  template <class Meets, class Found>
  void descend(NodePair top, const Meets& meets, const Found& found, Counts& counts) {
    // The last child first onto the stack: siblings must come into the slice side by side.
    const auto enter = [&](NodePair pair) {
      if (recursion_.is_leaf(pair)) {
        next_.push_back({pair, false, !(pair == top)});
        recursion_.for_each_object_pair(pair, [&](std::uint32_t i, std::uint32_t j) {
          ++counts.primitive_tests;
          if (meets(i, j)) found(i, j);
        });
        return;
      }
      const std::size_t first = open_.size();
      recursion_.for_each_child(pair, [&](NodePair child) { open_.push_back(child); });
      std::reverse(open_.begin() + static_cast<std::ptrdiff_t>(first), open_.end());
    };
    enter(top);
    while (!open_.empty()) {
      const NodePair pair = open_.back();
      open_.pop_back();
      if (are_clear(pair, counts))
        next_.push_back({pair, true, true});
      else
        enter(pair);
    }
  }

  /// Goes up as long as the last of the new slice are all children of one pair, and all clear, and it is, too.
  void add_clear(Entry entry, Counts& counts) {
    next_.push_back(entry);
    while (!recursion_.is_root(entry.pair)) {
      // The cheapest reason not to go up, and the most frequent one.
      if (next_.size() > 1 && !next_[next_.size() - 2].is_kept_clear() && !is_only_child(entry.pair)) return;
      const NodePair parent = recursion_.parent(entry.pair);
      const std::size_t family = recursion_.children(parent);
      if (family > next_.size()) return;
      const auto first = next_.end() - static_cast<std::ptrdiff_t>(family);
      const auto is_sibling = [&](const Entry& e) {
        return e.is_kept_clear() && !recursion_.is_root(e.pair) && recursion_.parent(e.pair) == parent;
      };
      if (!is_sibling(*first) || !std::all_of(first, next_.end(), is_sibling) || !are_clear(parent, counts)) return;
      entry.pair = parent;
      next_.erase(first, next_.end());
      next_.push_back(entry);
    }
  }

  bool is_only_child(NodePair pair) const { return recursion_.children(recursion_.parent(pair)) == 1; }

  const Hierarchy<V>&a_, &b_;
  Recursion recursion_;
  std::vector<Entry> slice_, next_;
  std::vector<NodePair> open_;  ///< scratch
};

}  // namespace boxstream::papers::volumes
