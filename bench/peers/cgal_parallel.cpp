// SPDX-License-Identifier: MIT
#include <CGAL/box_intersection_d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <string>

#include "peers/cgal_box.hpp"
#include "peers/peer.hpp"

namespace boxstream::bench {

namespace {

class CgalParallel final : public Peer {
 public:
  CgalParallel(std::size_t cutoff, unsigned threads)
      : cutoff_(static_cast<std::ptrdiff_t>(cutoff)), arena_(static_cast<int>(threads)) {}

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    copy_boxes(boxes, 0, copy_);
    for (std::vector<Pair>& found : found_) found.clear();
    const auto report = [this](const CgalBox& a, const CgalBox& b) {
      found_.local().push_back(a.index < b.index ? Pair{a.index, b.index} : Pair{b.index, a.index});
    };
    arena_.execute([&] {
      CGAL::box_self_intersection_d<CGAL::Parallel_tag>(copy_.begin(), copy_.end(), report, cutoff_,
                                                        CGAL::Box_intersection_d::CLOSED);
    });
    for (const std::vector<Pair>& found : found_) pairs.insert(pairs.end(), found.begin(), found.end());
  }

 private:
  std::ptrdiff_t cutoff_;
  tbb::task_arena arena_;
  std::vector<CgalBox> copy_;
  tbb::enumerable_thread_specific<std::vector<Pair>> found_;
};

}  // namespace

std::vector<PeerConfig> make_cgal_parallel_peers(unsigned threads) {
  std::vector<PeerConfig> peers;
  for (const std::size_t cutoff : cgal_cutoffs)
    peers.push_back({"cgal-tbb:" + std::to_string(cutoff), "cgal-tbb", threads, "",
                     std::make_unique<CgalParallel>(cutoff, threads)});
  return peers;
}

}  // namespace boxstream::bench
