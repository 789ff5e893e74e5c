// SPDX-License-Identifier: MIT
#include "batch/front/two_sets.hpp"

#include "base/thresholds.hpp"
#include "batch/cuts/cull.hpp"
#include "batch/records/columns.hpp"

namespace boxstream::detail {

template <class S>
bool CrossSearch::join(const BoxSource<S>& a, const BoxSource<S>& b, WideTree& tree) {
  const bool few_first = a.size() <= b.size();
  const BoxSource<S>&smaller = few_first ? a : b, &larger = few_first ? b : a;
  if (smaller.size() == 0) return tree.join_cross(a, b, {});
  const auto compare_all = [&] {
    FewAndMany valid;
    if (!compare_few(smaller.boxes(), larger.boxes(), faces, few_first, pairs, valid)) return false;
    ++stats.cells;
    stats.invalid += smaller.size() - valid.few + larger.size() - valid.many;
    stats.records += valid.few + valid.many;
    stats.tests += valid.few * valid.many;
    return true;
  };
  const std::uint64_t comparisons = std::uint64_t{a.size()} * b.size();
  if (smaller.size() <= thresholds.few &&
      comparisons <= thresholds.compared_before_culling + thresholds.fewest * larger.size())
    return compare_all();
  const Arena::Frame frame(arena);
  const Culled culled = cull(a, b, kinds, arena);
  if (!culled.worthwhile) {
    const bool are_few =
        smaller.size() <= thresholds.most_few && comparisons <= thresholds.compared_of_box * (a.size() + b.size());
    return are_few ? compare_all() : tree.join_cross(a, b, {});
  }
  stats.invalid += culled.invalid_a + culled.invalid_b;
  return tree.join_cross(RecordSource(culled.a), RecordSource(culled.b), {});
}

template bool CrossSearch::join(const BoxSource<float>&, const BoxSource<float>&, WideTree&);
template bool CrossSearch::join(const BoxSource<double>&, const BoxSource<double>&, WideTree&);

}  // namespace boxstream::detail
