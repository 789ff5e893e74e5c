// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "measure/stopwatch.hpp"
#include "peers/pair_hash.hpp"

namespace boxstream::bench {

/// The boxes that all methods of a comparison hold: cubes of sides around 1 with half a pair each. They sway: frame f
/// is frame f % frames.
class CliffScene {
 public:
  static constexpr std::size_t frames = 8;

  explicit CliffScene(std::size_t n);

  std::size_t size() const { return all_.size(); }
  /// Of frame 0.
  std::size_t pairs() const { return pairs_; }
  /// All ranks.
  Span<const std::uint32_t> all() const { return all_; }
  /// Box i in a frame.
  const Aabb& at(std::size_t frame, std::size_t i) const { return boxes_[frame % frames * size() + i]; }
  Span<const Aabb> frame(std::size_t frame) const { return {boxes_.data() + frame % frames * size(), size()}; }
  /// The same boxes, each at the place of another.
  Span<const Aabb> jumped(std::size_t frame) const { return {jumped_.data() + frame % frames * size(), size()}; }

 private:
  std::vector<std::uint32_t> all_;
  std::vector<Aabb> boxes_, jumped_;
  std::size_t pairs_ = 0;
};

/// What holds the boxes of a scene: ours, or a peer behind the same calls.
class Keeper {
 public:
  virtual ~Keeper() = default;

  /// All boxes of a frame, into an empty keeper.
  virtual void fill(Span<const Aabb> boxes) = 0;
  virtual void remove(std::uint32_t i) = 0;
  virtual void add(std::uint32_t i, const Aabb& box) = 0;
  /// One more than there are, until it leaves.
  virtual void come(const Aabb& box) = 0;
  virtual void leave() = 0;
  /// `boxes` has all boxes of a frame, `which` those that are set.
  virtual void move(Span<const std::uint32_t> which, Span<const Aabb> boxes) = 0;
  virtual void update() = 0;
  /// After `update`, not timed: the pairs whose boxes touch in `boxes`.
  virtual PairSummary pairs(Span<const Aabb> boxes) = 0;

  std::size_t turn = 0;  ///< of a call that differs from time to time
};

/// How a keeper came to be what it is.
enum class History { fresh, churned, asleep, jumped };
inline constexpr History histories[] = {History::fresh, History::churned, History::asleep, History::jumped};
std::string_view name_of(History history);

/// Fills an empty keeper and leads it through what was before.
void live_through(History history, Keeper& keeper, const CliffScene& scene);

/// A public call, on keepers of one kind. What `run` returns is the same for all of them.
struct CliffCall {
  std::string owner;  ///< "World" and the like
  std::string name;
  std::string description;
  std::unique_ptr<Keeper> (*make)();
  std::unique_ptr<Keeper> (*make_peer)();  ///< or null
  std::uint64_t (*run)(Keeper& keeper, const CliffScene& scene);
  bool has_history = true;                      ///< else a call needs no filled keeper
  measure::Clock clock = measure::Clock::wall;  ///< that of the processor takes longer to read than some calls
};

/// Those of one kind.
std::vector<CliffCall> frame_calls(std::string owner, std::unique_ptr<Keeper> (*make)(),
                                   std::unique_ptr<Keeper> (*make_peer)());
std::vector<CliffCall> world_calls();
std::vector<CliffCall> detector_calls();
std::vector<CliffCall> bullet_calls();
std::vector<CliffCall> fcl_calls();

/// btDbvtBroadphase.
std::unique_ptr<Keeper> make_dbvt_keeper();

}  // namespace boxstream::bench
