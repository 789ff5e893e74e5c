// SPDX-License-Identifier: MIT
#include "search.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::python {

static_assert(sizeof(Ball) == 4 * sizeof(float) && sizeof(Ball64) == 4 * sizeof(double));

namespace {

double distance_of(py::handle given, const char* name) {
  const double distance = number_of(given, name);
  if (!std::isfinite(distance) || distance < 0)
    throw py::value_error(std::string(name) + ": expected a finite number that is not below 0, got " + text_of(given));
  return distance;
}

/// With two sets, a tuple of an array or None for each.
py::tuple two(py::handle given, const char* name) {
  if (given.is_none()) return py::make_tuple(py::none(), py::none());
  if (!py::isinstance<py::tuple>(given) || py::len(given) != 2)
    throw py::type_error(std::string(name) + ": expected a tuple of two arrays of integers or None, as there are two " +
                         "sets of boxes, got an object of type " + type_of(given));
  return py::reinterpret_borrow<py::tuple>(given);
}

constexpr const char* renumber = "; numpy.unique(x, return_inverse=True)[1] numbers any that are equal alike";

/// Asks `what` of the module that knows how boxes are usually laid out.
template <class... Arguments>
void warn_of(const char* what, Arguments&&... arguments) {
  const boxstream::detail::DefaultFloatEnvironment
      environment;  // NumPy compares NaNs, which may be a trap of the caller's
  py::module_::import("boxstream._layout").attr(what)(std::forward<Arguments>(arguments)...);
}

/// So many that they are no accident.
bool are_many(std::uint64_t invalid, std::uint64_t boxes) {
  return invalid > boxes / 10;
}

}  // namespace

std::uint64_t invalid_of(const Boxes& boxes) {
  return with_scalar(boxes.scalar(), [&](auto s) {
    const boxstream::detail::DefaultFloatEnvironment environment;  // to compare a NaN may be a trap of the caller's
    const auto all = boxes.as<decltype(s)>();
    return static_cast<std::uint64_t>(
        std::count_if(all.begin(), all.end(), [](const auto& box) { return !is_valid(box); }));
  });
}

void warn_of_boxes(const Boxes& a, const Boxes* b, std::uint64_t invalid, std::uint64_t count) {
  if (are_many(invalid, count))
    warn_of("warn_of_boxes", a.array(), b ? py::object(b->array()) : py::none(), invalid, count);
}

Search::Search(const SearchArguments& given)
    : format_{dimensions_of(given.dimensions), may_copy(given.copy), invalid_policy(given.invalid)},
      a_(given.boxes, "boxes", format_) {
  rules_.touching = flag_of(given.closed, "closed");
  rules_.tolerance = distance_of(given.tolerance, "tolerance");
  const auto ids_of_set = [](py::handle ids, const char* name, std::size_t size) {
    return ids.is_none() ? std::vector<std::uint32_t>() : integers_of<std::uint32_t>(ids, name, size, renumber);
  };
  if (given.other.is_none()) {
    if (!given.ids_a.is_none() || !given.ids_b.is_none())
      throw py::type_error("ids_a, ids_b: are of two sets of boxes; those of one are ids");
    filters_a_ = filters_of(given.groups, given.masks, a_.size(), "");
    ids_a_ = ids_of_set(given.ids, "ids", a_.size());
  } else {
    if (!given.ids.is_none()) throw py::type_error("ids: are of one set of boxes; those of two are ids_a and ids_b");
    if (given.ids_a.is_none() != given.ids_b.is_none())
      throw py::type_error("ids_a, ids_b: expected both or neither, got one");
    b_.emplace(given.other, "other", format_);
    const py::tuple groups = two(given.groups, "groups"), masks = two(given.masks, "masks");
    filters_a_ = filters_of(groups[0], masks[0], a_.size(), "[0]");
    filters_b_ = filters_of(groups[1], masks[1], b_->size(), "[1]");
    ids_a_ = ids_of_set(given.ids_a, "ids_a", a_.size());
    ids_b_ = ids_of_set(given.ids_b, "ids_b", b_->size());
  }
  rules_.filters = filters_a_;
  rules_.filters_b = filters_b_;
  rules_.ids = ids_a_;
  rules_.ids_b = ids_b_;
}

void Search::warn(const Stats& stats) const {
  if (format_.invalid == Invalid::warn) warn_of_boxes(a_, b_ ? &*b_ : nullptr, stats.invalid, stats.boxes);
}

namespace {

template <class S>
bool is_valid_ball(const BasicBall<S>& ball) {
  return std::isfinite(ball.centre[0]) && std::isfinite(ball.centre[1]) && std::isfinite(ball.centre[2]) &&
         std::isfinite(ball.radius) && ball.radius >= 0;
}

/// Of points of `P`, which S has all numbers of.
template <class S, class P>
std::vector<BasicBall<S>> balls_of(const Numbers& points, const Numbers* radii, double radius, int dimensions) {
  const boxstream::detail::DefaultFloatEnvironment environment;  // some NaNs of floats are traps as doubles
  std::vector<BasicBall<S>> balls(points.size());
  const P* coordinate = points.data<P>();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (int d = 0; d < dimensions; ++d) balls[i].centre[d] = static_cast<S>(*coordinate++);
    for (int d = dimensions; d < 3; ++d) balls[i].centre[d] = 0;
    balls[i].radius = static_cast<S>(radii != nullptr ? radii->data<P>()[i] : radius);
  }
  return balls;
}

bool is_float(double x) {
  const boxstream::detail::DefaultFloatEnvironment environment;
  return static_cast<float>(x) == x;
}

}  // namespace

NearSearch::NearSearch(const NearArguments& given)
    : invalid_(invalid_policy(given.invalid)), distance_(distance_of(given.distance, "distance")) {
  const int dimensions = dimensions_of(given.dimensions);
  const Numbers points(given.points, "points", Wanted{{{dimensions}}});
  std::optional<Numbers> radii;
  if (!given.radii.is_none() && !is_one_number(given.radii)) {
    Wanted wanted{{{}}};
    wanted.owner = "points are";
    wanted.scalar = points.scalar();
    radii.emplace(given.radii, "radii", wanted);
    if (radii->size() != points.size())
      throw py::value_error("radii: expected one for each of " + std::to_string(points.size()) + " points, got " +
                            std::to_string(radii->size()));
  }
  const double radius = given.radii.is_none() || radii ? 0 : number_of(given.radii, "radii");
  // Nothing is rounded: with a radius that is no float, points of floats are centres of doubles.
  with_float(is_float(radius) ? points.scalar() : Scalar::float64, [&](auto s) {
    using S = decltype(s);
    auto balls = with_float(points.scalar(), [&](auto p) {
      return balls_of<S, decltype(p)>(points, radii ? &*radii : nullptr, radius, dimensions);
    });
    if (invalid_ == Invalid::raise)
      require_valid(Span<const BasicBall<S>>(balls), "points", "a number that is not finite, or a radius below 0",
                    is_valid_ball<S>);
    balls_ = std::move(balls);
  });
}

void NearSearch::warn(const Stats& stats) const {
  if (invalid_ != Invalid::warn || !are_many(stats.invalid, stats.boxes)) return;
  warn_of("warn_of_points", stats.invalid, stats.boxes);
}

}  // namespace boxstream::python
