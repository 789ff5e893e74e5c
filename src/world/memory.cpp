// SPDX-License-Identifier: MIT
// Memory that nothing needs goes back.
#include <algorithm>
#include <type_traits>

#include "world/core.hpp"

namespace boxstream {

using namespace detail;

/// What an update or a query makes anew is dropped as a whole, for its memory; the rest is as large as its contents.
template <class S>
void BasicWorld<S>::shrink_to_fit() {
  const InUse::Change change(impl_->in_use_);
  if (impl_->proxies_.tombstones() != 0) impl_->drop_tombstones();
  impl_->pairs_.fold();
  impl_->proxies_.shrink_to_fit();
  impl_->pairs_.shrink_to_fit();
  impl_->rows_.drop();
  impl_->index_.release();
  impl_->search_ = OverlapSearch<S>(impl_->options_);
  impl_->sorter_ = PairSorter();
  impl_->pairs_of_few_.give_back();
  impl_->drop_scratch();
}

/// What many pairs that begin or end at once take goes back after some updates with far fewer. `used` is how many the
/// last one had to do with.
template <class S>
void WorldParts<S>::give_back_unused(std::size_t used) noexcept {
  constexpr std::size_t little = 4096;
  constexpr unsigned patience = 8;
  const std::size_t scratch =
      std::max({all_found_.capacity(), fresh_.capacity(), found_.capacity(), gone_.capacity(), begun_.capacity(),
                next_begun_.capacity(), ended_.capacity(), next_ended_.capacity()});
  holds_much_ = scratch > little || pairs_.room() > little + 3 * pairs_.size();
  const bool lies_idle = holds_much_ && (scratch > little + 4 * used || pairs_.room() > little + 3 * pairs_.size());
  updates_with_less_ = lies_idle ? updates_with_less_ + 1 : 0;
  if (updates_with_less_ < patience) return;
  updates_with_less_ = 0;
  drop_scratch();
  sorter_.give_back();
  pairs_.give_back();
  pairs_of_few_.give_back();
  search_.fat_boxes().give_back();
}

/// All lists of pairs but the events of the last update.
template <class S>
void WorldParts<S>::drop_scratch() noexcept {
  const auto drop = [](auto&... vectors) { (std::remove_reference_t<decltype(vectors)>().swap(vectors), ...); };
  drop(all_found_, fresh_, accepted_, ended_pairs_, found_, gone_, refused_, kept_);
  drop(next_begun_, next_ended_, next_begun_places_, next_ended_places_, is_referenced_);
  for (auto* events : {&begun_, &ended_}) events->shrink_to_fit();
  for (auto* places : {&begun_places_, &ended_places_}) places->shrink_to_fit();
}

#define INSTANTIATE(S)                                                 \
  template void WorldParts<S>::give_back_unused(std::size_t) noexcept; \
  template void WorldParts<S>::drop_scratch() noexcept;                \
  template void BasicWorld<S>::shrink_to_fit()
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
