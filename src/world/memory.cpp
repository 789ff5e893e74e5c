// SPDX-License-Identifier: MIT
// Memory that nothing needs goes back.
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
  impl_->drop_scratch();
}

#define INSTANTIATE(S) template void BasicWorld<S>::shrink_to_fit()
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
