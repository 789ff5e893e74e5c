// SPDX-License-Identifier: MIT
#include "peers/plain.hpp"
#include "peers/soa.hpp"

namespace boxstream::bench {

namespace {

class BruteForce final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    arrays_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) arrays_.set(i, boxes[i], static_cast<std::uint32_t>(i));
    for (std::size_t i = 0; i < boxes.size(); ++i) arrays_.match(i, i + 1, boxes.size(), pairs);
  }

 private:
  BoxArrays arrays_;
};

}  // namespace

std::unique_ptr<Peer> make_brute_force() {
  return std::make_unique<BruteForce>();
}

}  // namespace boxstream::bench
