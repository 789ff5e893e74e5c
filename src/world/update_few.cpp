// SPDX-License-Identifier: MIT
// Updates where there are few proxies.
#include <algorithm>

#include "base/bits.hpp"
#include "base/thresholds.hpp"
#include "world/core.hpp"

namespace boxstream::detail {

/// Where there are few proxies: a row of bits for each that is dirty, or for all, beside the row of what is held. Pairs
/// of two that are not dirty are left as they are, so there are no refused ones among what is found.
template <class S>
void WorldParts<S>::compare_few(SearchMode mode, const ProxyPairFilter* accept) {
  rows_.follow(pairs_.lists(), pairs_.edition(), proxies_.ranks());
  found_.clear();
  gone_.clear();
  keeps_refused_ = false;
  if (proxies_.ranks() < 2) return;
  if (mode == SearchMode::rows) {
    compare_all_rows();
  } else {
    compare_dirty_rows();
    for (auto* keys : {&found_, &gone_})
      if (keys->size() > 1) std::sort(keys->begin(), keys->end());
  }
  if (!pairs_.recheck().empty()) {
    for_each_released([&](Pair pair) {
      if (!pairs_.lists().contains(pair_key(pair.a, pair.b))) found_.push_back(pair_key(pair.a, pair.b));
    });
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
  }
  if (found_.empty() && gone_.empty()) return;
  check_begun(found_.size());
  pairs_.lists().find_places(gone_, next_ended_places_);
  if (accept != nullptr) ask(*accept);
  search_.fat_boxes().held_changed(found_);
  search_.fat_boxes().held_changed(gone_);
}

template <class S>
void WorldParts<S>::compare_all_rows() {
  const std::size_t ranks = proxies_.ranks(), words = bit_words(ranks);
  std::uint64_t rows[FewBoxes<S>::most * FewBoxes<S>::most_words], is_dirty[FewBoxes<S>::most_words] = {};
  proxies_.few().find_rows(ranks, rows);
  for (const std::uint32_t rank : proxies_.dirty()) is_dirty[rank / 64] |= std::uint64_t{1} << rank % 64;
  for (std::uint32_t rank = 0; rank < ranks; ++rank) {
    const std::uint64_t *const found = rows + rank * words, *const held = rows_.row(rank);
    const std::uint64_t all = proxies_.is_dirty(rank) ? ~std::uint64_t{0} : 0;
    std::uint64_t behind = ~std::uint64_t{1} << rank % 64;
    for (std::size_t word = rank / 64; word < words; ++word, behind = ~std::uint64_t{0})
      compare_word(rank, word, found[word], held[word], behind & (all | is_dirty[word]));
  }
}

/// A pair of two dirty ones is seen to by the first.
template <class S>
void WorldParts<S>::compare_dirty_rows() {
  const std::size_t ranks = proxies_.ranks(), words = bit_words(ranks);
  std::uint64_t seen_to[FewBoxes<S>::most_words] = {}, row[FewBoxes<S>::most_words];
  for (const std::uint32_t rank : proxies_.dirty()) {
    seen_to[rank / 64] |= std::uint64_t{1} << rank % 64;
    proxies_.few().find_row(rank, ranks, row);
    const std::uint64_t* const held = rows_.row(rank);
    for (std::size_t word = 0; word < words; ++word) compare_word(rank, word, row[word], held[word], ~seen_to[word]);
  }
}

/// Of the pairs of `rank` those whose other rank is in a word, and `looked_at`. Mostly nothing is news.
template <class S>
inline void WorldParts<S>::compare_word(std::uint32_t rank, std::size_t word, std::uint64_t found, std::uint64_t held,
                                        std::uint64_t looked_at) {
  if (((found ^ held) & looked_at) != 0 || !proxies_.has_default_filters())
    change_word(rank, word, found & looked_at, held & looked_at);
}

template <class S>
void WorldParts<S>::change_word(std::uint32_t rank, std::size_t word, std::uint64_t found, std::uint64_t held) {
  std::uint64_t begins = found & ~held, ends = held & ~found;
  const auto other = [word](unsigned bit) { return static_cast<std::uint32_t>(64 * word + bit); };
  if (const Span<const Filter> filters = proxies_.batch_filters(); !filters.empty()) {
    const auto refused_of = [&](std::uint64_t some) {
      std::uint64_t refused = 0;
      for_each_bit(some, [&](unsigned bit) {
        if (!accepts(filters[rank], filters[other(bit)])) refused |= std::uint64_t{1} << bit;
      });
      return refused;
    };
    begins ^= refused_of(begins);
    if (!options_.sticky_filters) ends |= refused_of(held & found);
  }
  for_each_bit(begins, [&](unsigned bit) { found_.push_back(pair_key(rank, other(bit))); });
  for_each_bit(ends, [&](unsigned bit) { gone_.push_back(pair_key(rank, other(bit))); });
}

template void WorldParts<float>::compare_few(SearchMode, const ProxyPairFilter*);
template void WorldParts<double>::compare_few(SearchMode, const ProxyPairFilter*);

}  // namespace boxstream::detail
