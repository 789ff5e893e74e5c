// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/record/op.hpp"
#include "formats/record/replay.hpp"
#include "same_op.hpp"

class btBroadphaseInterface;

namespace boxstream::record_test {

using Bytes = std::vector<std::uint8_t>;

Bytes write(const std::vector<record::Op>& ops, const record::Header& header = {});

/// Throws RecordError.
std::vector<record::Op> read(const Bytes& bytes);

/// Whether streams have what only some broad-phases promise to get right: boxes that are invalid or infinite, and
/// filters that change.
enum class Temper { tame, wild };

/// A well-formed stream of about `length` ops that depends on nothing but the seed: a few dozen proxies on a small
/// grid, so that touching is common; now and then a box that is huge, flat, infinite, inverted or has a NaN. All
/// coordinates are exact in float. Batches hold the pairs they owe (as a right broad-phase leaves them).
std::vector<record::Op> random_ops(std::uint32_t seed, std::size_t length, Temper temper = Temper::wild);

/// One of each op, a few bytes each.
std::vector<record::Op> one_of_each();

std::unique_ptr<btBroadphaseInterface> make(const std::string& broadphase, std::size_t max_objects = 1000);

/// Replays on the broad-phases named.
record::ReplayResult replay_on(const Bytes& bytes, const std::vector<std::string>& broadphases);

/// The first difference as text; empty if there is none.
std::string difference_on(const Bytes& bytes, const std::vector<std::string>& broadphases);

}  // namespace boxstream::record_test
