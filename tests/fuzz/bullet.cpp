// SPDX-License-Identifier: MIT
// Streams of broad-phase calls on the Bullet adapter: at every batch it holds the pairs of an independent search, and
// every box query hits what that search says.
//
// Input: a .bsrec file (docs/bsrec.md); what comes before the first fault in it is played. Batches owe what the search
// finds, whatever the file claims, so that any change of a box is a stream of its own. Coordinates in double are taken
// in float. The first byte of the header's text chooses: bit 0 an executor that claims 3 threads; bits 1 and 2 which
// pairs are eager; bits 3 and 4 the cache (own, hashed, sorted). Eager pairs, and bit 5, a margin, are for streams
// without refilters: there, pairs begin at other times than in the search.
#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <boxstream/bullet.hpp>

#include "core/executors.hpp"
#include "finding.hpp"
#include "formats/record/expected_pairs.hpp"
#include "formats/record/player.hpp"
#include "formats/record/reader.hpp"
#include "formats/record/replay.hpp"
#include "formats/record/writer.hpp"

namespace boxstream::fuzz {
namespace {

using record::Op;

struct Stream {
  record::Header header;
  std::vector<Op> ops;
};

void round_to_float(double& x) {
  x = static_cast<double>(static_cast<float>(x));
}
void round_to_float(double (&v)[3]) {
  for (double& x : v) round_to_float(x);
}
void round_to_float(Aabb64& box) {
  round_to_float(box.min);
  round_to_float(box.max);
}

struct RoundToFloat {
  void operator()(record::Create& op) const { round_to_float(op.box); }
  void operator()(record::Move& op) const { round_to_float(op.box); }
  void operator()(record::BoxQuery& op) const { round_to_float(op.box); }
  void operator()(record::RayQuery& op) const {
    round_to_float(op.from);
    round_to_float(op.to);
    round_to_float(op.inverse_direction);
    round_to_float(op.length);
    round_to_float(op.extent_min);
    round_to_float(op.extent_max);
  }
  template <class Other>
  void operator()(Other&) const {}
};

std::optional<Stream> read(Span<const std::uint8_t> bytes) {
  std::optional<Stream> stream;
  try {
    record::Reader reader(bytes);
    stream = Stream{reader.header(), {}};
    while (std::optional<Op> op = reader.next()) {
      std::visit(RoundToFloat{}, *op);
      stream->ops.push_back(*op);
    }
  } catch (const record::RecordError& error) {
    promise_one_line(error.what());
  }
  if (!stream) return stream;
  stream->header.scalar = record::Scalar::float32;
  stream->header.bounds = record::Header{}.bounds;  // those of a double stream may be none in float
  stream->ops.push_back(record::Batch{});
  record::ExpectedPairs search;
  for (Op& op : stream->ops) {
    search.apply(op);
    if (auto* const batch = std::get_if<record::Batch>(&op)) batch->pairs = record::digest_of(search.pairs());
  }
  return stream;
}

std::vector<std::uint8_t> written(const Stream& stream) {
  std::ostringstream out;
  record::Writer writer(out, stream.header);
  for (const Op& op : stream.ops) writer.write(op);
  writer.finish();
  const std::string text = out.str();
  return {text.begin(), text.end()};
}

std::unique_ptr<btOverlappingPairCache> cache_of(unsigned choice) {
  if (choice == 1) return std::make_unique<btHashedOverlappingPairCache>();
  if (choice == 2) return std::make_unique<btSortedOverlappingPairCache>();
  return nullptr;
}

void play(const Stream& stream) {
  const unsigned choice = stream.header.about.empty() ? 0 : static_cast<unsigned char>(stream.header.about[0]);
  tests::InlineExecutor three(3);
  bullet::Options options;
  options.exact_boxes = true;
  options.executor = (choice & 1) != 0 ? &three : nullptr;
  const bool refilters = std::any_of(stream.ops.begin(), stream.ops.end(),
                                     [](const Op& op) { return std::holds_alternative<record::Refilter>(op); });
  if (!refilters) {
    const bullet::Eager eager[] = {bullet::Eager::ghosts, bullet::Eager::all, bullet::Eager::none,
                                   bullet::Eager::ghosts};
    options.eager = eager[choice >> 1 & 3];
    options.margin = (choice & 32) != 0 ? btScalar(0.25) : btScalar(0);
  }
  const std::unique_ptr<btOverlappingPairCache> cache = cache_of(choice >> 3 & 3);
  std::vector<std::unique_ptr<record::Player>> players;
  players.push_back(
      std::make_unique<record::Player>("boxstream", std::make_unique<bullet::Broadphase>(cache.get(), options)));
  const record::ReplayResult result = record::replay(written(stream), players);
  if (result.difference) found(describe(*result.difference, record::Scalar::float32));
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (const auto stream = boxstream::fuzz::read({data, size})) boxstream::fuzz::play(*stream);
  return 0;
}
