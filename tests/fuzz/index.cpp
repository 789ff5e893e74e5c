// SPDX-License-Identifier: MIT
// A BoxIndex against the plain model: all queries, as it was built and as it was stored; and damaged bytes, which are
// refused or make an index that answers.
//
// Input: byte 0: bit 0 double, bit 1 queries of the stored one as well, bit 2 damaged bytes get their checksum, bits 3
// to 5 how many changes damage them; for each two bytes where, and one what is there. Then boxes, and places in the
// other set (sets.hpp).
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "box_index/answers.hpp"
#include "box_index/stored_bytes.hpp"
#include "bytes.hpp"
#include "either_scalar.hpp"
#include "finding.hpp"
#include "sets.hpp"

namespace boxstream::fuzz {
namespace {

constexpr std::size_t most_boxes = 260, most_places = 12;

/// Visitors that stop at the first box.
template <class S>
void stop_early(const BasicBoxIndex<S>& index, const BasicAabb<S>& place) {
  std::size_t visits = 0;
  const auto stop = [&](std::uint32_t) { return ++visits, false; };
  index.query_box(place, stop);
  index.query_planes({}, stop);
  index.query_ray(BasicRay<S>::along(place.min, place.max, 1), [&](std::uint32_t, S, S) { return ++visits, S(-1); });
  index.query_nearest_box(place, std::numeric_limits<S>::infinity(), [&](std::uint32_t, S) { return ++visits, S(0); });
  promise(visits <= 4, "a query goes on though its visitor stopped it");
}

template <class S>
void load_damaged(const tests::StoredBytes& bytes, const tests::Boxes<S>& places) {
  try {
    const auto index = BasicBoxIndex<S>::load(bytes);
    std::vector<Pair> found;
    index.query_boxes(places, found);
    for (const Pair pair : found) promise(pair.a < places.size() && pair.b < index.size(), "a box that is not there");
    for (const auto& place : places) stop_early(index, place);
    const tests::StoredBytes again = index.save();
    promise(BasicBoxIndex<S>::load(again).save() == again, "an index that was loaded is stored in another way");
  } catch (const std::runtime_error& error) {
    const std::string why = error.what();
    promise(why.rfind("boxstream: ", 0) == 0 && why.find('\n') == std::string::npos, "why bytes are refused: " + why);
  }
}

template <class S>
void run(Bytes& in, unsigned flags) {
  struct Change {
    unsigned place, value;
  };
  std::vector<Change> changes(flags >> 3 & 7);
  for (Change& change : changes) {
    change.place = in.two_bytes();
    change.value = in.byte();
  }
  TwoSets<S> read = read_sets<S>(in, most_boxes);
  read.b.resize(std::min(read.b.size(), most_places));

  const BasicBoxIndex<S> index(read.a);
  tests::expect_answers(index, read.a, read.b);
  for (const auto& place : read.b) stop_early(index, place);
  tests::StoredBytes bytes = index.save();
  const auto loaded = BasicBoxIndex<S>::load(bytes);
  promise(loaded.save() == bytes, "an index that was loaded is stored in another way");
  if ((flags & 2) != 0) tests::expect_answers(loaded, read.a, read.b);
  promise(!testing::Test::HasFailure(), "index and model differ");

  if (changes.empty()) return;
  for (const Change change : changes) bytes[change.place % bytes.size()] = static_cast<std::uint8_t>(change.value);
  if ((flags & 4) != 0) tests::sign(bytes);
  load_damaged<S>(bytes, read.b);
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream::fuzz;
  return run_with_either_scalar(data, size, []<class S>(Bytes& in, unsigned flags) { run<S>(in, flags); });
}
