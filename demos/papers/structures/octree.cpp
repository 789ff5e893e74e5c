// SPDX-License-Identifier: MIT
#include "papers/structures/octree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace boxstream::papers {

namespace {

/// Sub-cell numbers have the bits x, y, z from the highest down, as in figure 18.
constexpr unsigned bit_of(unsigned axis) {
  return 4u >> axis;
}

}  // namespace

Octree::Octree(Span<const Aabb> boxes, OctreeOptions options) : boxes_(boxes), options_(options) {
  if (boxes.empty()) return;
  Aabb all = boxes[0];
  for (const Aabb& box : boxes) all = merged(all, box);
  double diagonal = 0, largest = 0;
  for (int d = 0; d < 3; ++d) {
    diagonal = std::hypot(diagonal, double{all.max[d]} - double{all.min[d]});
    largest = std::max({largest, std::abs(double{all.min[d]}), std::abs(double{all.max[d]})});
  }
  // ray_enter has t within 2^-23 of its size, so it is off by 2^-17 diagonals where the ray begins 64 diagonals away;
  // the parameters of cells, in double, are off by far less.
  slack_ = 0x1p-16 * diagonal + 0x1p-40 * largest + 1e-30;
  for (unsigned d = 0; d < 3; ++d) {
    bounds_.low[d] = double{all.min[d]} - slack_;
    bounds_.high[d] = double{all.max[d]} + slack_;
  }
  std::vector<std::uint32_t> objects(boxes.size());
  for (std::size_t i = 0; i < objects.size(); ++i) objects[i] = static_cast<std::uint32_t>(i);
  cells_.push_back({});
  build(0, bounds_, objects, options_.depth);
}

void Octree::build(std::size_t cell, const Bounds& bounds, const std::vector<std::uint32_t>& objects, int levels_left) {
  Vector middle;
  for (unsigned d = 0; d < 3; ++d) middle[d] = 0.5 * (bounds.low[d] + bounds.high[d]);
  std::array<std::vector<std::uint32_t>, 8> parts;
  std::size_t listed = 0;
  if (levels_left > 0 && objects.size() > options_.most_in_leaf)
    for (const std::uint32_t object : objects) {
      unsigned low = 0, high = 0;  // bits of the axes along which it has a part of the lower, or the upper, half
      for (unsigned d = 0; d < 3; ++d) {
        if (double{boxes_[object].min[d]} - slack_ <= middle[d]) low |= bit_of(d);
        if (double{boxes_[object].max[d]} + slack_ >= middle[d]) high |= bit_of(d);
      }
      for (unsigned part = 0; part < 8; ++part)
        if ((part & ~high) == 0 && (~part & 7u & ~low) == 0) {
          parts[part].push_back(object);
          ++listed;
        }
    }
  if (listed == 0 || listed >= 3 * objects.size()) {
    cells_[cell] = {static_cast<std::uint32_t>(lists_.size()), static_cast<std::uint32_t>(objects.size()), true};
    lists_.insert(lists_.end(), objects.begin(), objects.end());
    return;
  }
  const std::size_t first = cells_.size();
  cells_[cell] = {static_cast<std::uint32_t>(first), 0, false};
  cells_.resize(first + 8);
  for (unsigned part = 0; part < 8; ++part) {
    Bounds half = bounds;
    for (unsigned d = 0; d < 3; ++d) ((part & bit_of(d)) != 0 ? half.low : half.high)[d] = middle[d];
    build(first + part, half, parts[part], levels_left - 1);
    parts[part] = {};
  }
}

/// One ray as it is traversed, as section 2.5.1 has it: by its parameters at the borders of cells, which halve as cells
/// do.
class Octree::Shot {
 public:
  Shot(const Octree& tree, const Ray& ray, Mailboxes& mail) : tree_(tree), ray_(ray), mail_(mail) {
    // A ray along a plane never meets it; in the paper's terms it does, very far away.
    constexpr double most = 1e200;
    if (++mail_.ray_ == 0) {
      std::fill(mail_.last_.begin(), mail_.last_.end(), 0u);
      mail_.ray_ = 1;
    }
    for (unsigned d = 0; d < 3; ++d) {
      const double inverse = std::clamp(double{ray.inverse_direction[d]}, -most, most);
      double near = tree.bounds_.low[d], far = tree.bounds_.high[d];
      if (inverse < 0) {
        std::swap(near, far);
        mirror_ |= bit_of(d);
      }
      low_[d] = (near - double{ray.origin[d]}) * inverse;
      high_[d] = (far - double{ray.origin[d]}) * inverse;
    }
  }

  FirstHit run() {
    if (entry(low_) < exit(high_)) traverse(0, low_, high_);
    return best_;
  }

 private:
  static double entry(const Vector& low) { return std::max({low[0], low[1], low[2]}); }
  static double exit(const Vector& high) { return std::min({high[0], high[1], high[2]}); }

  /// Cells come in the order in which the ray enters them. False: what comes now is beyond the first hit, or the ray.
  bool traverse(std::size_t cell, const Vector& low, const Vector& high) {
    if (exit(high) < 0) return true;
    const double near = entry(low) * (1 - 0x1p-20);
    if (near > double{best_.enter} || near > double{ray_.length}) return false;
    const Cell& c = tree_.cells_[cell];
    if (c.is_leaf) {
      test(c);
      return true;
    }
    Vector middle;
    for (unsigned d = 0; d < 3; ++d) middle[d] = 0.5 * (low[d] + high[d]);
    // The ray is in the upper half along an axis if it has passed the middle before it entered the cell.
    unsigned sub = 0;
    for (unsigned d = 0; d < 3; ++d)
      if (middle[d] < entry(low)) sub |= bit_of(d);
    for (;;) {
      Vector sub_low, sub_high;
      for (unsigned d = 0; d < 3; ++d) {
        const bool upper = (sub & bit_of(d)) != 0;
        sub_low[d] = upper ? middle[d] : low[d];
        sub_high[d] = upper ? high[d] : middle[d];
      }
      if (!traverse(c.first + (sub ^ mirror_), sub_low, sub_high)) return false;
      // It leaves by the border that it meets first: into the neighbour along that axis, or out of the cell.
      const auto side = static_cast<unsigned>(std::min_element(sub_high.begin(), sub_high.end()) - sub_high.begin());
      if ((sub & bit_of(side)) != 0) return true;
      sub |= bit_of(side);
    }
  }

  void test(const Cell& cell) {
    for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) {
      const std::uint32_t object = tree_.lists_[i];
      if (mail_.last_[object] == mail_.ray_) continue;
      mail_.last_[object] = mail_.ray_;
      best_.offer(ray_enter(ray_, tree_.boxes_[object]), object);
    }
  }

  const Octree& tree_;
  const Ray& ray_;
  Mailboxes& mail_;
  unsigned mirror_ = 0;
  Vector low_{}, high_{};
  FirstHit best_;
};

FirstHit Octree::first_hit(const Ray& ray, Mailboxes& mail) const {
  bool far_off = false;
  double diagonal = 0;
  for (unsigned d = 0; d < 3; ++d) diagonal = std::hypot(diagonal, bounds_.high[d] - bounds_.low[d]);
  for (unsigned d = 0; d < 3; ++d) {
    const double o = double{ray.origin[d]};
    far_off |= std::abs(o - bounds_.low[d]) > 32 * diagonal;
  }
  FirstHit best;
  if (boxes_.empty()) return best;
  if (!far_off) return Shot(*this, ray, mail).run();
  // From further away, ray_enter rounds by more than the slack.
  for (std::size_t i = 0; i < boxes_.size(); ++i) best.offer(ray_enter(ray, boxes_[i]), static_cast<std::uint32_t>(i));
  return best;
}

}  // namespace boxstream::papers
