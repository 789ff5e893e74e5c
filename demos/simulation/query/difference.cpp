// SPDX-License-Identifier: MIT
#include "simulation/query/difference.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace boxstream::query {
namespace {

std::string pair_text(const ObjectMotion& motion, const Hit& hit) {
  return fmt::format("{} - {}", motion.name(hit.a), motion.name(hit.b));
}

std::string only_one_has(const ObjectMotion& motion, const Hit& hit, const std::string& has,
                         const std::string& has_not) {
  return fmt::format("{}: found by {}, not by {}", pair_text(motion, hit), has, has_not);
}

std::string value_text(const Query& query, const Hit& hit) {
  return query.kind == Kind::within ? fmt::format("at {:.17g}", hit.distance)
                                    : fmt::format("{} contacts", hit.contacts);
}

std::string hits_difference(const Query& query, const ObjectMotion& motion, const std::string& name_x, const Answer& x,
                            const std::string& name_y, const Answer& y) {
  const auto [i, j] = std::mismatch(x.hits.begin(), x.hits.end(), y.hits.begin(), y.hits.end());
  const bool end_x = i == x.hits.end(), end_y = j == y.hits.end();
  if (end_x && end_y) return {};
  if (!end_x && !end_y && i->a == j->a && i->b == j->b)
    return fmt::format("{}: {} {}, {} {}", pair_text(motion, *i), name_x, value_text(query, *i), name_y,
                       value_text(query, *j));
  const bool in_x = end_y || (!end_x && std::pair(i->a, i->b) < std::pair(j->a, j->b));
  return in_x ? only_one_has(motion, *i, name_x, name_y) : only_one_has(motion, *j, name_y, name_x);
}

}  // namespace

std::string difference(const Query& query, const ObjectMotion& motion, const std::string& name_x, const Answer& x,
                       const std::string& name_y, const Answer& y) {
  if (query.kind == Kind::first)
    return x.touching == y.touching ? std::string()
                                    : fmt::format("{} finds a pair that touches, {} none", x.touching ? name_x : name_y,
                                                  x.touching ? name_y : name_x);
  if (query.kind == Kind::distance)
    return x.distance == y.distance
               ? std::string()
               : fmt::format("least distance {:.17g} on {}, {:.17g} on {}", x.distance, name_x, y.distance, name_y);
  return hits_difference(query, motion, name_x, x, name_y, y);
}

}  // namespace boxstream::query
