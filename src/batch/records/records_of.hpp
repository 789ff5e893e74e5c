// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <boxstream/span.hpp>

#include "base/arena.hpp"
#include "batch/records/load.hpp"
#include "batch/records/record.hpp"
#include "batch/records/source.hpp"

namespace boxstream::detail {

/// The valid boxes of a source, all in a row.
inline Span<const Record> records_of(const RecordSource& source, Arena&) {
  return source.size() == 0 ? Span<const Record>() : Span<const Record>(&source[0], source.size());
}

template <class S>
Span<Record> records_of(const BoxSource<S>& source, Arena& arena) {
  const std::size_t n = source.size();
  auto* records = arena.allocate<Record>(n + load_block);
  std::size_t size = 0;
  for (std::size_t begin = 0; begin < n; begin += load_block) {
    const std::size_t count = std::min(load_block, n - begin);
    const std::uint64_t valid = source.load(begin, count, records + size).valid;
    if (valid == ~std::uint64_t{0} >> (load_block - count)) {
      size += count;
    } else {
      const Record* const block = records + size;
      for (std::size_t i = 0; i < count; ++i)
        if ((valid >> i & 1) != 0) records[size++] = block[i];
    }
  }
  return {records, size};
}

}  // namespace boxstream::detail
