// SPDX-License-Identifier: MIT
#include "cliffs/keeper.hpp"

#include <boxstream/detector.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace boxstream::bench {
namespace {

std::uint64_t all_move(Keeper& keeper, const CliffScene& scene) {
  keeper.move(scene.all(), scene.frame(++keeper.turn));
  keeper.update();
  return 0;
}

/// The same ones each time.
std::uint64_t few_move(Keeper& keeper, const CliffScene& scene) {
  keeper.move(scene.all().subspan(0, (scene.size() + 19) / 20), scene.frame(++keeper.turn));
  keeper.update();
  return 0;
}

/// The next ones each time.
std::uint64_t others_move(Keeper& keeper, const CliffScene& scene) {
  const std::size_t many = (scene.size() + 19) / 20, moved = keeper.turn++ * many;
  const std::size_t first = moved % scene.size();
  keeper.move(scene.all().subspan(first, std::min(many, scene.size() - first)), scene.frame(moved / scene.size() + 1));
  keeper.update();
  return 0;
}

/// Another one each time. One whose turn comes again goes to another place than the last time.
std::uint64_t one_moves(Keeper& keeper, const CliffScene& scene) {
  const std::size_t turn = keeper.turn++;
  keeper.move(scene.all().subspan(turn % scene.size(), 1), scene.frame(turn / scene.size() + 1));
  keeper.update();
  return 0;
}

std::uint64_t none_moves(Keeper& keeper, const CliffScene& scene) {
  keeper.move(scene.all(), scene.frame(0));
  keeper.update();
  return 0;
}

std::uint64_t all_jump(Keeper& keeper, const CliffScene& scene) {
  keeper.move(scene.all(), scene.jumped(++keeper.turn));
  keeper.update();
  return 0;
}

std::uint64_t out_and_in(Keeper& keeper, const CliffScene& scene) {
  const auto i = static_cast<std::uint32_t>(++keeper.turn * 7 % scene.size());
  keeper.remove(i);
  keeper.update();
  keeper.add(i, scene.at(0, i));
  keeper.update();
  return 0;
}

std::uint64_t comes_and_goes(Keeper& keeper, const CliffScene& scene) {
  keeper.come(scene.at(1, ++keeper.turn * 7 % scene.size()));
  keeper.update();
  keeper.leave();
  keeper.update();
  return 0;
}

}  // namespace

CliffScene::CliffScene(std::size_t n) : all_(n) {
  std::iota(all_.begin(), all_.end(), 0u);
  std::mt19937_64 engine(n);
  const auto random = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(engine() >> 11) / 9007199254740992.0);
  };
  const double room = std::cbrt(8.0 * static_cast<double>(n));
  std::vector<Aabb> homes(n);
  for (Aabb& home : homes)
    for (int d = 0; d < 3; ++d) {
      home.min[d] = random(0, room);
      home.max[d] = home.min[d] + random(0.5, 1.5);
    }
  for (std::size_t f = 0; f < frames; ++f) {
    std::vector<Aabb> now = homes;
    for (Aabb& box : now)
      for (int d = 0; d < 3; ++d) {
        const float away = random(-0.05, 0.05);
        box.min[d] += away;
        box.max[d] += away;
      }
    boxes_.insert(boxes_.end(), now.begin(), now.end());
    const std::size_t shift = f * (n / 3 + 1);
    for (std::size_t i = 0; i < n; ++i) jumped_.push_back(now[(i + shift) % n]);
  }
  pairs_ = find_pairs(frame(0)).size();
}

std::string_view name_of(History history) {
  switch (history) {
    case History::fresh:
      return "fresh";
    case History::churned:
      return "after churn";
    case History::asleep:
      return "after sleep";
    case History::jumped:
      return "after jumps";
  }
  return "";
}

void live_through(History history, Keeper& keeper, const CliffScene& scene) {
  keeper.fill(scene.frame(0));
  keeper.update();
  const auto n = static_cast<std::uint32_t>(scene.size());
  for (int round = 0; history == History::churned && round < 3; ++round) {
    for (std::uint32_t i = 0; i < n; i += 2) keeper.remove(i);
    keeper.update();
    for (std::uint32_t i = 0; i < n; i += 2) keeper.add(i, scene.at(0, i));
    keeper.update();
  }
  for (int frame = 0; history == History::asleep && frame < 20; ++frame) keeper.update();
  for (std::size_t frame = 0; history == History::jumped && frame < 4; ++frame) {
    keeper.move(scene.all(), frame < 3 ? scene.jumped(frame + 1) : scene.frame(0));
    keeper.update();
  }
}

std::vector<CliffCall> frame_calls(std::string owner, std::unique_ptr<Keeper> (*make)(),
                                   std::unique_ptr<Keeper> (*make_peer)()) {
  std::vector<CliffCall> calls;
  const auto add = [&](std::string name, std::string description, auto run) {
    calls.push_back({owner, std::move(name), std::move(description), make, make_peer, run});
  };
  add("all move", "all boxes move by a tenth of their side, and pairs are brought up to date", all_move);
  add("5 % move", "the same of the first twentieth", few_move);
  add("others move", "the same of the next twentieth each time", others_move);
  add("one moves", "the same of one box, another each time", one_moves);
  add("none moves", "all boxes are set to where they are", none_moves);
  add("all jump", "all boxes change places", all_jump);
  add("out and in", "one is removed, and added again, each with an update", out_and_in);
  add("comes and goes", "one more is added, and removed again, each with an update", comes_and_goes);
  return calls;
}

}  // namespace boxstream::bench
