// SPDX-License-Identifier: MIT
#include "boxes/ways.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "boxes/fat_boxes.hpp"
#include "ours.hpp"

namespace boxstream::report {
namespace {

class Rooms final : public bench::Peer {
 public:
  Rooms(double share, bool tested) : share_(share), tested_(tested) {}

  void prepare(Span<const Aabb>) override { boxes_ = std::make_unique<FatBoxes>(share_); }
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    boxes_->start(boxes);
    hand_over(boxes, pairs);
  }
  void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved, std::vector<Pair>& pairs) override {
    boxes_->next_frame(boxes, moved);
    hand_over(boxes, pairs);
  }
  void release() override { boxes_.reset(); }

 private:
  void hand_over(Span<const Aabb> boxes, std::vector<Pair>& pairs) const {
    const std::vector<Pair>& candidates = boxes_->candidates();
    if (!tested_) {
      pairs = candidates;
      return;
    }
    pairs.clear();
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(pairs),
                 [&](Pair pair) { return overlaps(boxes[pair.a], boxes[pair.b]); });
  }

  double share_;
  bool tested_;
  std::unique_ptr<FatBoxes> boxes_;
};

Way make_way(const std::string& name, const nlohmann::json& settings) {
  Way way;
  way.series = name;
  way.most = settings.value("most", std::size_t{0});
  if (name == "detector") {
    way.peer = bench::make_detector(nullptr);
  } else if (name == "world") {
    way.peer = bench::make_world(nullptr);
  } else if (name == "rooms" || name == "rooms-tested") {
    way.x = settings.at("room").get<double>();
    way.setting = fmt::format("{:g} %", 100 * way.x);
    way.superset = name == "rooms";
    way.peer = std::make_unique<Rooms>(way.x, !way.superset);
  } else {
    std::string known = "detector, world, rooms, rooms-tested";
    for (bench::PeerConfig& config : bench::make_peers(1)) {
      known += ", " + config.name;
      if (config.name != name) continue;
      way.known_difference = config.known_difference;
      way.peer = std::move(config.peer);
      return way;
    }
    throw std::invalid_argument(fmt::format("no way \"{}\"; there are {}", name, known));
  }
  return way;
}

}  // namespace

std::vector<Way> read_ways(const nlohmann::json& list) {
  std::vector<Way> ways;
  for (const nlohmann::json& entry : list) {
    const nlohmann::json settings = entry.is_string() ? nlohmann::json{{"way", entry}} : entry;
    ways.push_back(make_way(settings.at("way").get<std::string>(), settings));
  }
  if (ways.empty()) throw std::invalid_argument("no ways");
  return ways;
}

}  // namespace boxstream::report
