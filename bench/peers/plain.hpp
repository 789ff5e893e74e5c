// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "peers/peer.hpp"

namespace boxstream::bench {

std::unique_ptr<Peer> make_brute_force();
std::unique_ptr<Peer> make_sweep();

}  // namespace boxstream::bench
