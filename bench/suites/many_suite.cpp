// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <boxstream/detector.hpp>

#include "inputs/batches.hpp"
#include "inputs/motion.hpp"
#include "peers/ours.hpp"
#include "suites/race.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

/// Frames of many sets of the same size, each with a batch U of its own.
class Worlds {
 public:
  Worlds(std::size_t count, std::size_t size, Motion motion, std::uint64_t seed) : size_(size) {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<Aabb> set = scaled_to_unit_sides(batches::make("U", size, seed + i));
      boxes.insert(boxes.end(), set.begin(), set.end());
      offsets_.push_back(boxes.size());
    }
    MovingBoxes moving(std::move(boxes), motion, seed);
    moved_.resize(count);
    for (const std::uint32_t i : moving.moved()) moved_[i / size].push_back(static_cast<std::uint32_t>(i % size));
    for (int frame = 0; frame < frames_one_way; ++frame, moving.next_frame())
      frames_.emplace_back(moving.boxes().begin(), moving.boxes().end());
  }

  /// A run goes through the frames and back, so that it may be repeated.
  static constexpr int frames_one_way = 4, frames_of_run = 2 * (frames_one_way - 1);
  template <class Do>
  void run(const Do& with_frame) const {
    for (int i = 1; i < frames_one_way; ++i) with_frame(frames_[static_cast<std::size_t>(i)]);
    for (int i = frames_one_way - 1; i-- > 0;) with_frame(frames_[static_cast<std::size_t>(i)]);
  }

  const std::vector<Aabb>& first() const { return frames_[0]; }
  const std::vector<std::uint64_t>& offsets() const { return offsets_; }
  std::size_t count() const { return moved_.size(); }
  Span<const std::uint32_t> moved(std::size_t set) const { return moved_[set]; }
  Span<const Aabb> set(const std::vector<Aabb>& boxes, std::size_t i) const {
    return Span<const Aabb>(boxes).subspan(static_cast<std::size_t>(offsets_[i]), size_);
  }

 private:
  std::size_t size_;
  std::vector<std::uint64_t> offsets_{0};
  std::vector<std::vector<Aabb>> frames_;
  std::vector<std::vector<std::uint32_t>> moved_;  // of each set
};

/// Appends the pairs of set `i` to those of sets before it.
void append(const Worlds& worlds, std::size_t i, const std::vector<Pair>& pairs, PairsOfSets& all) {
  const auto first = static_cast<std::uint32_t>(worlds.offsets()[i]);
  for (const Pair pair : pairs) all.pairs.push_back({pair.a + first, pair.b + first});
  all.offsets.push_back(all.pairs.size());
}

/// A method of finding the pairs of a frame, set by set: `find(boxes, i, pairs)`.
template <class Find>
auto each(const Worlds& worlds, const Find& find) {
  return [&worlds, find, pairs = std::vector<Pair>()](const std::vector<Aabb>& boxes, PairsOfSets* all) mutable {
    if (all != nullptr) *all = {{}, {0}};
    for (std::size_t i = 0; i < worlds.count(); ++i) {
      find(boxes, i, pairs);
      if (all != nullptr) append(worlds, i, pairs, *all);
    }
  };
}

/// The pairs of each frame of a run, in order within each set.
template <class Method>
std::vector<PairsOfSets> pairs_of_run(const Worlds& worlds, Method& method) {
  std::vector<PairsOfSets> frames;
  worlds.run([&](const std::vector<Aabb>& boxes) {
    PairsOfSets all;
    method(boxes, &all);
    for (std::size_t i = 0; i < worlds.count(); ++i)
      std::sort(all.pairs.begin() + static_cast<std::ptrdiff_t>(all.offsets[i]),
                all.pairs.begin() + static_cast<std::ptrdiff_t>(all.offsets[i + 1]));
    frames.push_back(std::move(all));
  });
  return frames;
}

bool are_equal(const std::vector<PairsOfSets>& a, const std::vector<PairsOfSets>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const PairsOfSets& x, const PairsOfSets& y) {
    return x.pairs == y.pairs && x.offsets == y.offsets;
  });
}

/// Peers that live from frame to frame, one a set, with pairs of their own. Filled and searched once.
class PeerOfEach {
 public:
  template <class Make>
  PeerOfEach(const Worlds& worlds, const Make& make) : worlds_(worlds), kept_(worlds.count()) {
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      kept_[i].peer = make();
      kept_[i].peer->find_pairs(worlds.set(worlds.first(), i), kept_[i].pairs);
    }
  }

  void step(const std::vector<Aabb>& boxes, std::size_t i, std::vector<Pair>& pairs) {
    kept_[i].peer->next_frame(worlds_.set(boxes, i), worlds_.moved(i), kept_[i].pairs);
    pairs = kept_[i].pairs;
  }

 private:
  struct Kept {
    std::unique_ptr<Peer> peer;
    std::vector<Pair> pairs;
  };
  const Worlds& worlds_;
  std::vector<Kept> kept_;
};

void run_case(const std::string& name, std::size_t size, Motion motion, std::size_t n, const Options& options,
              Report& report, Progress& progress) {
  const Worlds worlds(std::max<std::size_t>(n / size, 1), size, motion, options.seed);
  Race race(options, report, progress, {.suite = "many", .case_name = name, .n = worlds.first().size()});
  race.units = Worlds::frames_of_run;

  Detector detector;
  PairsOfSets found;
  auto ours = [&](const std::vector<Aabb>& boxes, PairsOfSets* all) {
    detector.find_pairs(boxes, worlds.offsets(), found);
    if (all != nullptr) *all = found;
  };
  const std::vector<PairsOfSets> expected = pairs_of_run(worlds, ours);
  race.row.k = expected.back().pairs.size();

  // `kept`: with all pairs in one array, as ours are, and not only those of the last set.
  const auto add = [&](const std::string& method_name, const std::string& family, auto method, bool kept) {
    const auto shared = std::make_shared<decltype(method)>(std::move(method));
    const auto all = std::make_shared<PairsOfSets>();
    race.add(
        method_name,
        [&worlds, shared, all, kept] {
          worlds.run([&](const std::vector<Aabb>& boxes) { (*shared)(boxes, kept ? all.get() : nullptr); });
        },
        [&worlds, &expected, shared] { return are_equal(pairs_of_run(worlds, *shared), expected); }, family);
  };
  Detector one_by_one;
  const auto call = [&](const std::vector<Aabb>& boxes, std::size_t i, std::vector<Pair>& pairs) {
    one_by_one.find_pairs(worlds.set(boxes, i), pairs);
  };
  add("calls", "calls", each(worlds, call), false);
  add("calls-kept", "calls-kept", each(worlds, call), true);
  const auto add_peers = [&](const std::string& method_name, const std::string& family, const auto& make) {
    if (!options.wants_peer(family)) return;
    const auto peers = std::make_shared<PeerOfEach>(worlds, make);
    const auto step = [peers](const std::vector<Aabb>& boxes, std::size_t i, std::vector<Pair>& pairs) {
      peers->step(boxes, i, pairs);
    };
    add(method_name, family, each(worlds, step), false);
  };
  add_peers("worlds", "worlds", [] { return make_world(nullptr); });
  const std::vector<PeerConfig> of_bullet = make_bullet_peers();
  for (std::size_t which = 0; which < of_bullet.size(); ++which)
    if (of_bullet[which].name.rfind("dbvt", 0) == 0)
      add_peers(of_bullet[which].name, "dbvt", [which] { return std::move(make_bullet_peers()[which].peer); });
  race.run([&] { worlds.run([&](const std::vector<Aabb>& boxes) { ours(boxes, nullptr); }); });
}

constexpr struct {
  const char* name;
  std::size_t size, count;
  Motion motion;
  const char* description;
} cases[] = {
    {"10:brown", 10, 65536, Motion::brown, "sets of 10 boxes, all of which move"},
    {"10:static5", 10, 65536, Motion::static5, "sets of 10, a twentieth of the boxes moves"},
    {"100:brown", 100, 4096, Motion::brown, "sets of 100, all move"},
    {"100:static5", 100, 4096, Motion::static5, "sets of 100, a twentieth moves"},
};

}  // namespace

std::vector<CaseText> many_case_texts() {
  return texts_of(cases);
}

void run_many_suite(const Options& options, Report& report, Progress& progress) {
  for (const auto& each : cases) {
    if (!options.wants_case(each.name)) continue;
    for (const std::size_t n : options.sizes_or({20000}, {each.count * each.size}))
      run_case(each.name, each.size, each.motion, n, options, report, progress);
  }
}

}  // namespace boxstream::bench
