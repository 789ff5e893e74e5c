// SPDX-License-Identifier: MIT
#include "pictures/viewer/upright_box.hpp"

#include <cmath>
#include <cstddef>

namespace boxstream::view {
namespace {

/// Of forms whose box is that of their scale.
bool is_box_like(const Form& form) {
  using Kind = scenes::Drawable::Kind;
  return form.kind == Kind::box || form.kind == Kind::cylinder || form.kind == Kind::cone || form.kind == Kind::capsule;
}

Point halves_of(const Form& form, const Point& scale) {
  const bool is_capsule = form.kind == scenes::Drawable::Kind::capsule;
  return {scale[0], is_capsule ? scale[1] * (1 + form.ratio) : scale[1], scale[2]};
}

}  // namespace

std::vector<Point> lone_halves(const Model& model) {
  std::vector<std::size_t> counts(model.states.size());
  for (const Part& part : model.parts) ++counts[part.object];
  std::vector<Point> halves(model.states.size());
  for (const Part& part : model.parts)
    if (counts[part.object] == 1 && is_box_like(model.forms[part.form]) && part.position == Point{} &&
        part.rotation == no_rotation)
      halves[part.object] = halves_of(model.forms[part.form], part.scale);
  return halves;
}

std::array<double, 3> upright_halves(const Point& halves, const std::array<double, 4>& q) {
  const auto [x, y, z, w] = q;
  const double length = x * x + y * y + z * z + w * w;
  if (!(length > 0)) return {};
  const double rows[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - z * w), 2 * (x * z + y * w)},
                             {2 * (x * y + z * w), w * w - x * x + y * y - z * z, 2 * (y * z - x * w)},
                             {2 * (x * z - y * w), 2 * (y * z + x * w), w * w - x * x - y * y + z * z}};
  std::array<double, 3> result{};
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t k = 0; k < 3; ++k) result[d] += std::fabs(rows[d][k]) * double{halves[k]};
    result[d] /= length;
  }
  return result;
}

}  // namespace boxstream::view
