// SPDX-License-Identifier: MIT
#include "peers/ours.hpp"

#include <stdexcept>

#include <boxstream/detector.hpp>
#include <boxstream/world.hpp>

#include "thread_pool.hpp"

namespace boxstream::bench {

namespace {

class OurDetector final : public OurMethod {
 public:
  explicit OurDetector(Executor* executor) : detector_({executor}) {}

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override { detector_.find_pairs(boxes, pairs); }
  std::size_t scratch_bytes() const override { return detector_.scratch_bytes(); }

 private:
  Detector detector_;
};

class OurWorld final : public OurMethod {
 public:
  explicit OurWorld(Executor* executor) : options_{executor, false} {}

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    world_ = std::make_unique<World>(options_);
    ids_.resize(boxes.size());
    world_->create(boxes, {}, ids_);
    for (std::uint32_t i = 0; i < ids_.size(); ++i)
      if (ids_[i].slot != i) throw std::logic_error("slots of a new World do not count up");
    world_->update();
    write(pairs);
  }

  void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved, std::vector<Pair>& pairs) override {
    if (moved.size() == boxes.size()) {
      world_->move(ids_, boxes);
    } else {
      moved_ids_.clear();
      moved_boxes_.clear();
      for (const std::uint32_t i : moved) {
        moved_ids_.push_back(ids_[i]);
        moved_boxes_.push_back(boxes[i]);
      }
      world_->move(moved_ids_, moved_boxes_);
    }
    const WorldStats stats = world_->update();
    if (stats.begun != 0 || stats.ended != 0) write(pairs);
  }

  void release() override { world_.reset(); }

 private:
  void write(std::vector<Pair>& pairs) {
    pairs.resize(static_cast<std::size_t>(world_->pair_count()));
    Pair* out = pairs.data();
    world_->stream_pairs([&out](Span<const ProxyPair> held) {
      for (const ProxyPair& pair : held) *out++ = {pair.a.slot, pair.b.slot};
      return true;
    });
  }

  WorldOptions options_;
  std::unique_ptr<World> world_;
  std::vector<ProxyId> ids_, moved_ids_;
  std::vector<Aabb> moved_boxes_;
};

}  // namespace

std::unique_ptr<OurMethod> make_detector(Executor* executor) {
  return std::make_unique<OurDetector>(executor);
}

std::unique_ptr<OurMethod> make_world(Executor* executor) {
  return std::make_unique<OurWorld>(executor);
}

OurMethod& Ours::on(unsigned threads) {
  Kept& kept = kept_[threads];
  if (!kept.method) {
    if (threads > 1) kept.executor = std::make_unique<threads::ThreadPool>(threads);
    kept.method = make_(kept.executor.get());
  }
  return *kept.method;
}

}  // namespace boxstream::bench
