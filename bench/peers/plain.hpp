// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "peers/peer.hpp"

namespace boxstream::bench {

std::unique_ptr<Peer> make_brute_force();
std::unique_ptr<Peer> make_sweep();
std::unique_ptr<Peer> make_plain_tree();

}  // namespace boxstream::bench
