// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "arrays.hpp"

namespace boxstream::python {

/// What a search is of, as the caller gave it: one set of boxes or two, and rules.
struct SearchArguments {
  py::handle boxes, other, groups, masks, ids, ids_a, ids_b, closed, tolerance, dimensions, copy, invalid;
};

/// The same, read.
class Search {
 public:
  explicit Search(const SearchArguments& given);

  bool has_other() const { return b_.has_value(); }
  BoxSpan a() const { return a_.span(); }
  BoxSpan b() const { return b_->span(); }
  const PairRules& rules() const { return rules_; }
  std::size_t boxes() const { return a_.size() + (b_ ? b_->size() : 0); }

  /// The warning that many boxes are invalid, if that was asked for.
  void warn(const Stats& stats) const;

 private:
  BoxFormat format_;
  Boxes a_;
  std::optional<Boxes> b_;
  std::vector<Filter> filters_a_, filters_b_;
  std::vector<std::uint32_t> ids_a_, ids_b_;
  PairRules rules_;
};

/// How many are invalid.
std::uint64_t invalid_of(const Boxes& boxes);

/// The warning that more than a tenth of boxes are invalid, if they are; `b` may be null.
void warn_of_boxes(const Boxes& a, const Boxes* b, std::uint64_t invalid, std::uint64_t count);

struct NearArguments {
  py::handle points, distance, radii, dimensions, invalid;
};

/// Balls, and how far apart they may be.
class NearSearch {
 public:
  explicit NearSearch(const NearArguments& given);

  double distance() const { return distance_; }
  std::size_t points() const {
    return std::visit([](const auto& balls) { return balls.size(); }, balls_);
  }
  /// `use(balls)`.
  template <class Use>
  auto visit(Use use) const {
    return std::visit([&]<class B>(const std::vector<B>& balls) { return use(Span<const B>(balls)); }, balls_);
  }
  void warn(const Stats& stats) const;

 private:
  Invalid invalid_;
  double distance_;
  std::variant<std::vector<Ball>, std::vector<Ball64>> balls_;
};

}  // namespace boxstream::python
