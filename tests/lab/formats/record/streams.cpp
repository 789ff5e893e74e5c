// SPDX-License-Identifier: MIT
#include "streams.hpp"

#include <algorithm>
#include <limits>
#include <random>
#include <sstream>

#include "formats/record/expected_pairs.hpp"
#include "formats/record/reader.hpp"
#include "formats/record/writer.hpp"
#include "formats/scene_model/scene.hpp"
#include "simulation/engine/broadphases.hpp"

namespace boxstream::record_test {

using namespace record;

Bytes write(const std::vector<Op>& ops, const Header& header) {
  std::ostringstream out;
  Writer writer(out, header);
  for (const Op& op : ops) writer.write(op);
  writer.finish();
  const std::string text = out.str();
  return {text.begin(), text.end()};
}

std::vector<Op> read(const Bytes& bytes) {
  Reader reader(bytes);
  std::vector<Op> ops;
  while (auto op = reader.next()) ops.push_back(*op);
  return ops;
}

namespace {

class Maker {
 public:
  Maker(std::uint32_t seed, Temper temper) : random_(seed), wild_(temper == Temper::wild) {}

  std::vector<Op> ops(std::size_t length) {
    while (ops_.size() < length) one();
    add(batch());
    return std::move(ops_);
  }

 private:
  // Distributions of the standard library give other numbers elsewhere.
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  Aabb64 box() {
    Aabb64 box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = below(d == 0 ? 20 : 6) * 0.5;
      box.max[d] = box.min[d] + below(7) * 0.25;
    }
    const int axis = below(3);
    switch (below(40)) {
      case 0:
        if (wild_) box.min[axis] = -std::numeric_limits<double>::infinity();
        break;
      case 1:
        box.max[axis] = std::numeric_limits<float>::max();
        break;
      case 2:
        if (wild_) box.min[axis] = std::numeric_limits<double>::quiet_NaN();
        break;
      case 3:
        if (wild_) std::swap(box.min[axis], box.max[axis]);
        break;
      case 4:
        box.min[axis] = -0.0;
        break;
      case 5:
        box.max[axis] = box.min[axis] = std::numeric_limits<float>::denorm_min();
        break;
      default:
        break;
    }
    return box;
  }

  void add(const Op& op) {
    expected_.apply(op);
    ops_.push_back(op);
  }

  Batch batch() { return {digest_of(expected_.pairs())}; }

  void one() {
    if (alive_.size() < 3 || below(100) < 8) {
      alive_.push_back(created_);
      add(Create{created_++, below(40), 1 << below(3), below(4) == 0 ? below(8) : -1, box()});
      return;
    }
    const std::size_t place = static_cast<std::size_t>(below(static_cast<int>(alive_.size())));
    const std::uint32_t id = alive_[place];
    const int what = below(100);
    if (what < 55) {
      add(Move{id, box()});
    } else if (what < 61) {
      add(Destroy{id});
      alive_.erase(alive_.begin() + static_cast<std::ptrdiff_t>(place));
    } else if (what < 66) {
      if (wild_) add(Refilter{id, 1 << below(3), below(8)});
    } else if (what < 76) {
      add(BoxQuery{box()});
    } else if (what < 84) {
      add(ray());
    } else if (what < 99) {
      add(batch());
    } else {
      add(ResetPool{});
    }
  }

  RayQuery ray() {
    RayQuery ray{};
    for (int d = 0; d < 3; ++d) {
      ray.from[d] = below(10);
      ray.to[d] = below(10) - 0.5;
      ray.inverse_direction[d] = 1 << below(4);
    }
    ray.length = below(20);
    if (below(3) == 0) ray.extent_min[below(3)] = -0.25;
    return ray;
  }

  std::mt19937 random_;
  bool wild_;
  std::vector<Op> ops_;
  ExpectedPairs expected_;
  std::vector<std::uint32_t> alive_;
  std::uint32_t created_ = 0;
};

}  // namespace

std::vector<Op> random_ops(std::uint32_t seed, std::size_t length, Temper temper) {
  return Maker(seed, temper).ops(length);
}

std::vector<Op> one_of_each() {
  const Aabb64 unit{{0, 0, 0}, {1, 1, 1}}, right{{1, 0, 0}, {2, 1, 1}}, away{{5, 0, 0}, {6, 1, 1}};
  RayQuery ray{};
  ray.from[0] = -3;
  ray.to[0] = 3;
  ray.inverse_direction[0] = 1;
  ray.inverse_direction[1] = ray.inverse_direction[2] = 1e18F;
  ray.length = 6;
  RayQuery thick = ray;
  thick.extent_max[2] = 0.5;
  return {Create{0, 8, 1, -1, unit},
          Create{1, 0, 2, 3, right},
          Batch{digest_of({{0, 1}})},
          BoxQuery{unit},
          ray,
          thick,
          Move{1, away},
          Refilter{0, 4, -5},
          Batch{},
          Destroy{0},
          Destroy{1},
          ResetPool{},
          Create{2, 0, 1, 1, unit},
          Batch{}};
}

std::unique_ptr<btBroadphaseInterface> make(const std::string& broadphase, std::size_t max_objects) {
  return scenes::make_broadphase(broadphase, {{-100, -100, -100}, {100, 100, 100}}, max_objects);
}

ReplayResult replay_on(const Bytes& bytes, const std::vector<std::string>& broadphases) {
  const std::size_t most = std::max<std::size_t>(1, census_of(bytes).most_alive);
  std::vector<std::unique_ptr<Player>> players;
  for (const std::string& name : broadphases) players.push_back(std::make_unique<Player>(name, make(name, most)));
  return replay(bytes, players);
}

std::string difference_on(const Bytes& bytes, const std::vector<std::string>& broadphases) {
  const ReplayResult result = replay_on(bytes, broadphases);
  return result.difference ? describe(*result.difference, Scalar::float32) : "";
}

}  // namespace boxstream::record_test
