// SPDX-License-Identifier: MIT
#include <boxstream/decomposition.hpp>

#include <bit>
#include <limits>
#include <vector>

#include "out_of_core/hash.hpp"
#include "out_of_core/regions.hpp"

namespace boxstream {

using detail::Region;

namespace {

template <class S>
std::vector<detail::KeyBox<S>> keys_of_valid(Span<const BasicAabb<S>> boxes) {
  std::vector<detail::KeyBox<S>> keys;
  keys.reserve(boxes.size());
  for (const BasicAabb<S>& box : boxes)
    if (detail::has_valid_keys(box)) keys.emplace_back(box);
  return keys;
}

template <class S>
S coordinate_of(typename Region<S>::Key key) {
  using Key = typename Region<S>::Key;
  constexpr Key most = std::numeric_limits<Key>::max();
  return std::bit_cast<S>(key ^ ((key >> std::numeric_limits<Key>::digits) & most));
}

}  // namespace

bool is_sampled(std::uint64_t id, std::uint64_t boxes, std::size_t parts) {
  constexpr std::uint64_t of_part = 512;
  if (boxes / of_part <= parts) return true;
  return detail::hash_of(id) < UINT64_MAX / boxes * (of_part * parts);
}

template <class S>
struct BasicDecomposition<S>::Impl {
  detail::Regions<S> regions;
};

template <class S>
BasicDecomposition<S>::BasicDecomposition(Span<const BasicAabb<S>> sample, std::size_t parts)
    : impl_(new Impl{detail::Regions<S>(keys_of_valid(sample), parts)}) {}

template <class S>
BasicDecomposition<S>::~BasicDecomposition() = default;
template <class S>
BasicDecomposition<S>::BasicDecomposition(BasicDecomposition&&) noexcept = default;
template <class S>
BasicDecomposition<S>& BasicDecomposition<S>::operator=(BasicDecomposition&&) noexcept = default;

template <class S>
std::size_t BasicDecomposition<S>::size() const {
  return impl_->regions.size();
}

template <class S>
BasicAabb<S> BasicDecomposition<S>::bounds(std::size_t part) const {
  constexpr S inf = std::numeric_limits<S>::infinity();
  const Region<S>& region = impl_->regions[part];
  BasicAabb<S> box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = region.first[d] == Region<S>::lowest ? -inf : coordinate_of<S>(region.first[d]);
    box.max[d] = region.last[d] == Region<S>::highest ? inf : coordinate_of<S>(region.last[d] + 1);
  }
  return box;
}

template <class S>
void BasicDecomposition<S>::for_each_touched(const BasicAabb<S>& box, FunctionRef<void(std::size_t)> visit) const {
  if (detail::has_valid_keys(box)) impl_->regions.for_each_touched(box, visit);
}

template <class S>
std::uint8_t BasicDecomposition<S>::before(std::size_t part, const BasicAabb<S>& box) const {
  return impl_->regions[part].before(box);
}

template class BasicDecomposition<float>;
template class BasicDecomposition<double>;

}  // namespace boxstream
