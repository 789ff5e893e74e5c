// SPDX-License-Identifier: MIT
#pragma once

#include "bytes.hpp"

namespace boxstream::fuzz {

/// The first byte of an input has flags; bit 0 says whether its boxes are of double or of float. `run` is a template
/// over that: run.operator()<S>(in, flags).
template <class Run>
int run_with_either_scalar(const std::uint8_t* data, std::size_t size, Run run) {
  Bytes in(data, size);
  const unsigned flags = in.byte();
  if ((flags & 1) != 0)
    run.template operator()<double>(in, flags);
  else
    run.template operator()<float>(in, flags);
  return 0;
}

}  // namespace boxstream::fuzz
