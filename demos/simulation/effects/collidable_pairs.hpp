// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/scene_model/expand.hpp"

namespace boxstream::effects {

/// Which bodies of a scene can touch: one of the two is dynamic, Bullet's filter accepts their groups, and neither
/// `exclusions` nor a joint excludes the pair. Wherever they are, for bodies move.
class CollidablePairs {
 public:
  /// `expanded` has to outlive it.
  explicit CollidablePairs(const scenes::Expanded& expanded);

  /// The number of bodies for which `has(body)` is true, by class.
  template <class Has>
  std::vector<std::uint32_t> count(Has has) const {
    std::vector<std::uint32_t> counts(classes_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) counts[class_of_body_[i]] += has(bodies_[i]) ? 1 : 0;
    return counts;
  }

  /// How many bodies with `has` body i can touch; `counts` is `count(has)`.
  template <class Has>
  std::size_t partners(std::size_t i, const std::vector<std::uint32_t>& counts, Has has) const {
    const Class& mine = classes_[class_of_body_[i]];
    std::size_t count = 0;
    for (std::size_t c = 0; c < classes_.size(); ++c) count += meet(mine, classes_[c]) ? counts[c] : 0;
    const auto leave_out = [&](std::size_t j) {
      count -= meet(mine, classes_[class_of_body_[j]]) && has(bodies_[j]) ? 1 : 0;
    };
    leave_out(i);
    for (auto at = excluded_of(i); at != excluded_.end() && (*at)[0] == i; ++at) leave_out((*at)[1]);
    return count;
  }

  /// Whether bodies i and k could touch if nothing excluded the pair.
  bool accept(std::size_t i, std::size_t k) const {
    return meet(classes_[class_of_body_[i]], classes_[class_of_body_[k]]);
  }

  bool can_touch(std::size_t i, std::size_t k) const {
    return i != k && accept(i, k) && !std::binary_search(excluded_.begin(), excluded_.end(), std::array{i, k});
  }

  /// Whether body i can touch what is no rigid body, but has this group and mask in Bullet's filter.
  bool meets_other(std::size_t i, std::uint32_t group, std::uint32_t mask) const {
    const Class& mine = classes_[class_of_body_[i]];
    return (mine.group & mask) != 0 && (group & mine.mask) != 0;
  }

  /// The first body with `one(body)` that can touch another with `other(body)`.
  template <class One, class Other>
  std::optional<std::size_t> first(One one, Other other) const {
    const std::vector<std::uint32_t> others = count(other);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (one(bodies_[i]) && partners(i, others, other) > 0) return i;
    return std::nullopt;
  }

 private:
  /// What decides, apart from excluded pairs. Scenes have few classes, with many bodies each.
  struct Class {
    std::uint32_t group, mask;
    bool is_dynamic;
    auto operator<=>(const Class&) const = default;
  };

  static Class class_of(const scenes::BodyTraits& traits);
  static bool meet(const Class& a, const Class& b) {
    return (a.is_dynamic || b.is_dynamic) && (a.group & b.mask) != 0 && (b.group & a.mask) != 0;
  }
  std::vector<std::array<std::size_t, 2>>::const_iterator excluded_of(std::size_t body) const;

  const std::vector<scenes::Body>& bodies_;
  std::vector<Class> classes_;
  std::vector<std::uint32_t> class_of_body_;
  std::vector<std::array<std::size_t, 2>> excluded_;  // each pair both ways, in order
};

}  // namespace boxstream::effects
