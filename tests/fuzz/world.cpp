// SPDX-License-Identifier: MIT
// Histories of a World against the plain model: after each operation all that can be seen of both is the same, and the
// World's invariants hold.
//
// Input: byte 0: bit 0 double, bit 1 filters are sticky, bits 2 and 3 the way to search (probe, all, candidates,
// cheapest), bit 4 an executor that claims 4 threads, bit 5 a wide grid, bit 6 each call in another floating-point
// environment, some from another thread, bit 7 that executor does its last task first; byte 1: how many boxes there are
// in the palette; these boxes (bytes.hpp). Then operations of 4 bytes: kind (order of `Kind`; f8 to ff for those after
// `clear`), which proxies, and two bytes for a value. Values below 0x8000 stand for boxes of the palette, the others
// for drawn ones.
#include <vector>

#include "bytes.hpp"
#include "core/executors.hpp"
#include "either_scalar.hpp"
#include "finding.hpp"
#include "world/moody_world.hpp"
#include "world/player.hpp"

namespace boxstream::fuzz {
namespace {

// The model looks at all pairs at each update.
constexpr std::size_t most_proxies = 100;
constexpr int most_ops = 60;

tests::Kind read_kind(Bytes& in) {
  constexpr auto first_kinds = static_cast<unsigned>(tests::Kind::clear) + 1;
  constexpr auto all_kinds = static_cast<unsigned>(tests::Kind::refilter_all) + 1;
  const unsigned code = in.byte();
  if (code == 0xff) return tests::Kind::shrink_to_fit;
  return static_cast<tests::Kind>(code < 0xf8 ? code % first_kinds : first_kinds + code % (all_kinds - first_kinds));
}

template <class S, class World, class BoxOf>
void play(Bytes& in, World& world, const WorldOptions& options, BoxOf box_of) {
  tests::Player<S, World> player(world, options.sticky_filters, box_of);
  for (int i = 0; i < most_ops && !in.empty(); ++i) {
    const tests::Kind kind = read_kind(in);
    const unsigned which = in.byte();
    const tests::Op op{kind, which, in.two_bytes()};
    const bool creates =
        kind == tests::Kind::create || kind == tests::Kind::create_many || kind == tests::Kind::bulk_create;
    if (creates && player.size() > most_proxies) continue;
    player.play(op);
    promise(!testing::Test::HasFailure(), "World and model differ after operation " + std::to_string(i));
  }
}

template <class S>
void run(Bytes& in, unsigned flags) {
  const detail::SearchMode modes[] = {detail::SearchMode::probe, detail::SearchMode::all,
                                      detail::SearchMode::candidates, detail::SearchMode::cheapest};
  std::vector<BasicAabb<S>> palette(in.below(32));
  for (BasicAabb<S>& box : palette) box = in.box<S>();
  const unsigned grid = (flags & 32) != 0 ? 40 : 8;
  const auto box_of = [&](unsigned value) {
    return palette.empty() || value >= 0x8000 ? tests::box_from<S>(value, grid) : palette[value % palette.size()];
  };

  tests::InlineExecutor first_task_first(4);
  tests::ReversedExecutor last_task_first(4);
  Executor& four = (flags & 128) != 0 ? static_cast<Executor&>(last_task_first) : first_task_first;
  WorldOptions options;
  options.executor = (flags & 16) != 0 ? &four : nullptr;
  options.sticky_filters = (flags & 2) != 0;
  const auto mode = modes[flags >> 2 & 3];
  if ((flags & 64) != 0) {
    tests::MoodyWorld<S> world(options, mode, flags);
    play<S>(in, world, options, box_of);
  } else {
    detail::WorldCore<S> world(options, mode);
    play<S>(in, world, options, box_of);
  }
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream::fuzz;
  return run_with_either_scalar(data, size, []<class S>(Bytes& in, unsigned flags) { run<S>(in, flags); });
}
