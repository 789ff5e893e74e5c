// SPDX-License-Identifier: MIT
#include "formats/record/op.hpp"

#include <fmt/format.h>

#include "base/words.hpp"

namespace boxstream::record {
namespace {

std::string text_of(double value, Scalar scalar) {
  return scalar == Scalar::float32 ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
}

std::string text_of(const double (&v)[3], Scalar scalar) {
  return fmt::format("[{} {} {}]", text_of(v[0], scalar), text_of(v[1], scalar), text_of(v[2], scalar));
}

struct Line {
  Scalar scalar;

  std::string operator()(const Create& op) const {
    return fmt::format("create {} shape {} group {} mask {} box {}", op.id, op.shape, op.group, op.mask,
                       record::text_of(op.box, scalar));
  }
  std::string operator()(const Move& op) const {
    return fmt::format("move {} to {}", op.id, record::text_of(op.box, scalar));
  }
  std::string operator()(const Destroy& op) const { return fmt::format("destroy {}", op.id); }
  std::string operator()(const Refilter& op) const {
    return fmt::format("refilter {} group {} mask {}", op.id, op.group, op.mask);
  }
  std::string operator()(const BoxQuery& op) const { return "box query " + record::text_of(op.box, scalar); }
  std::string operator()(const RayQuery& op) const {
    return fmt::format("ray query from {} to {} inverse direction {} length {} extents {} to {}",
                       text_of(op.from, scalar), text_of(op.to, scalar), text_of(op.inverse_direction, scalar),
                       text_of(op.length, scalar), text_of(op.extent_min, scalar), text_of(op.extent_max, scalar));
  }
  std::string operator()(const Batch& op) const {
    return fmt::format("batch {} pairs, hash {:016x}", op.pairs.count, op.pairs.hash);
  }
  std::string operator()(const ResetPool&) const { return "reset pool"; }
};

}  // namespace

std::string text_of(const Aabb64& box, Scalar scalar) {
  return text_of(box.min, scalar) + " to " + text_of(box.max, scalar);
}

std::string text_of(const Op& op, Scalar scalar) {
  return std::visit(Line{scalar}, op);
}

std::string text_of(const Header& header) {
  return fmt::format("{}, bounds {}: {}", header.scalar == Scalar::float32 ? "float" : "double",
                     text_of(header.bounds, header.scalar), files::printable(header.about));
}

}  // namespace boxstream::record
