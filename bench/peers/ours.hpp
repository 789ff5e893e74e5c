// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <memory>

#include <boxstream/executor.hpp>

#include "peers/peer.hpp"

namespace boxstream::bench {

/// One of our own methods of finding pairs: a peer that also reports its scratch memory.
class OurMethod : public Peer {
 public:
  /// Bytes beyond input and output; 0 where that is not known.
  virtual std::size_t scratch_bytes() const { return 0; }
};

/// Detector::find_pairs with warm scratch; each frame anew.
std::unique_ptr<OurMethod> make_detector(Executor* executor);

/// A World that lives from frame to frame. Its list of pairs is written again when an update reports a change.
std::unique_ptr<OurMethod> make_world(Executor* executor);

/// The same method on any number of threads, made on first use.
class Ours {
 public:
  using Make = std::unique_ptr<OurMethod> (*)(Executor*);
  explicit Ours(Make make) : make_(make) {}

  OurMethod& on(unsigned threads);

 private:
  struct Kept {
    std::unique_ptr<Executor> executor;
    std::unique_ptr<OurMethod> method;
  };

  Make make_;
  std::map<unsigned, Kept> kept_;
};

}  // namespace boxstream::bench
