// SPDX-License-Identifier: MIT
#include "rules_truth.hpp"

#include <cmath>

namespace boxstream::fuzz {

namespace {

using tests::Boxes;
using tests::Pairs;

/// Whether a low end reaches a high one: low <= high + tolerance, or low < high + tolerance if touching does not count.
bool reaches(double low, double high, const PairRules& rules) {
  // What is infinite is no farther, or nearer, by a tolerance.
  if (std::isinf(low) || std::isinf(high) || rules.tolerance == 0) return rules.touching ? low <= high : low < high;
  const double gap = low - high;
  if (gap != rules.tolerance) return gap < rules.tolerance;  // rounding keeps the order
  // What was lost of the difference, exactly, decides.
  const double part = gap - low, lost = (low - (gap - part)) - (high + part);
  return rules.touching ? lost <= 0 : lost < 0;
}

bool meet(const BasicAabb<double>& a, const BasicAabb<double>& b, const PairRules& rules) {
  for (int d = 0; d < 3; ++d)
    if (!reaches(a.min[d], b.max[d], rules) || !reaches(b.min[d], a.max[d], rules)) return false;
  return true;
}

struct Named {
  Span<const Filter> filters;
  Span<const std::uint32_t> ids;
};

bool permit(const Named& a, std::size_t i, const Named& b, std::size_t j) {
  if (!a.ids.empty() && !b.ids.empty() && a.ids[i] == b.ids[j]) return false;
  return tests::permit(a.filters.empty() ? Filter{} : a.filters[i], b.filters.empty() ? Filter{} : b.filters[j]);
}

void add_pairs_of(std::uint32_t i, const Boxes<double>& a, const Boxes<double>& b, std::uint32_t from,
                  const Named& of_a, const Named& of_b, const PairRules& rules, Pairs& pairs) {
  if (!tests::makes_sense(a[i])) return;
  for (std::uint32_t j = from; j < b.size(); ++j)
    if (meet(a[i], b[j], rules) && tests::makes_sense(b[j]) && permit(of_a, i, of_b, j)) pairs.push_back({i, j});
}

}  // namespace

Pairs truth(const Boxes<double>& boxes, const PairRules& rules) {
  Pairs pairs;
  const Named named{rules.filters, rules.ids};
  for (std::uint32_t i = 0; i < boxes.size(); ++i) add_pairs_of(i, boxes, boxes, i + 1, named, named, rules, pairs);
  return pairs;
}

Pairs truth(const Boxes<double>& a, const Boxes<double>& b, const PairRules& rules) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    add_pairs_of(i, a, b, 0, {rules.filters, rules.ids}, {rules.filters_b, rules.ids_b}, rules, pairs);
  return pairs;
}

}  // namespace boxstream::fuzz
