// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "peers/peer.hpp"

namespace boxstream::bench {

void Peer::next_frame(Span<const Aabb> boxes, Span<const std::uint32_t>, std::vector<Pair>& pairs) {
  find_pairs(boxes, pairs);
}

#ifndef BOXSTREAM_BENCH_BULLET_PEERS
std::vector<PeerConfig> make_bullet_peers() {
  return {};
}
#endif

std::vector<PeerConfig> make_peers([[maybe_unused]] unsigned threads) {
  std::vector<PeerConfig> peers;
  const auto append = [&peers](std::vector<PeerConfig> more) {
    peers.insert(peers.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
#ifdef BOXSTREAM_BENCH_CGAL
  append(make_cgal_peers());
#endif
#ifdef BOXSTREAM_BENCH_CGAL_PARALLEL
  append(make_cgal_parallel_peers(threads));
#endif
  append(make_bullet_peers());
#ifdef BOXSTREAM_BENCH_FCL
  append(make_fcl_peers());
#endif
#ifdef BOXSTREAM_BENCH_EMBREE
  append(make_embree_peers());
#endif
#ifdef BOXSTREAM_BENCH_PAPERS
  append(make_paper_peers());
#endif
  append(make_hybrid_peers());
  append(make_plain_peers());
  return peers;
}

std::vector<PeerConfig> choose_peers(std::vector<PeerConfig> peers, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted)
    if (std::none_of(peers.begin(), peers.end(), [&](const PeerConfig& peer) { return peer.family == name; })) {
      std::string message = "no peer '" + name + "' in this suite; there are";
      std::string last;
      for (const PeerConfig& peer : peers)
        if (peer.family != last) message += ' ' + (last = peer.family);
      throw std::invalid_argument(message);
    }
  if (!wanted.empty())
    std::erase_if(peers, [&](const PeerConfig& peer) {
      return std::find(wanted.begin(), wanted.end(), peer.family) == wanted.end();
    });
  return peers;
}

}  // namespace boxstream::bench
