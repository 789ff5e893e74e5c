// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "detector.hpp"

namespace boxstream::python {

static_assert(sizeof(Ball) == 4 * sizeof(float) && sizeof(Ball64) == 4 * sizeof(double));

namespace {

template <class S>
bool is_valid_ball(const BasicBall<S>& ball) {
  return std::isfinite(ball.centre[0]) && std::isfinite(ball.centre[1]) && std::isfinite(ball.centre[2]) &&
         std::isfinite(ball.radius) && ball.radius >= 0;
}

/// Balls of the shape (n, 4), used where they lie, or points of the shape (n, 3), copied.
template <class S>
class Balls {
 public:
  explicit Balls(const Floats& given) {
    if (given.columns() == 4) {
      span_ = {reinterpret_cast<const BasicBall<S>*>(given.data<S>()), given.size()};
      return;
    }
    const S* point = given.data<S>();
    points_.reserve(given.size());
    for (std::size_t i = 0; i < given.size(); ++i, point += 3) points_.push_back({{point[0], point[1], point[2]}, 0});
    span_ = points_;
  }
  Balls(const Balls&) = delete;
  Balls& operator=(const Balls&) = delete;

  Span<const BasicBall<S>> span() const { return span_; }

 private:
  std::vector<BasicBall<S>> points_;
  Span<const BasicBall<S>> span_;
};

/// Calls `use(balls, distance)` for what the caller gave.
template <class Use>
auto with_balls(py::handle given, py::handle distance, py::handle invalid, Use use) {
  const Invalid policy = invalid_policy(invalid);
  const Floats floats(given, "balls", {{3}, {4}});
  return with_scalar(floats.scalar(), [&](auto s) {
    using S = decltype(s);
    const double within = number_of<double>(distance, "distance");
    if (!std::isfinite(within) || within < 0)
      throw py::value_error("distance: expected a finite number that is not below 0, got " + text_of(distance));
    const Balls<S> balls(floats);
    if (policy == Invalid::raise)
      require_valid(balls.span(), "balls", "a number that is not finite, or a radius below 0", is_valid_ball<S>);
    return use(balls.span(), within);
  });
}

}  // namespace

py::array PyDetector::find_near_pairs(py::handle balls, py::handle distance, py::handle invalid) {
  return with_balls(balls, distance, invalid, [&](auto span, auto within) {
    std::vector<Pair> pairs;
    run([&](Detector& detector, const Unlocked&) { return boxstream::find_near_pairs(detector, span, within, pairs); });
    return array_of<std::uint32_t>(std::move(pairs));
  });
}

std::uint64_t PyDetector::stream_near_pairs(py::handle balls, py::handle distance, py::handle callback,
                                            py::handle block, py::handle invalid) {
  return with_balls(balls, distance, invalid, [&](auto span, auto within) {
    return stream(callback, block, [&](Detector& detector, PairSink sink) {
      return boxstream::stream_near_pairs(detector, span, within, sink);
    });
  });
}

}  // namespace boxstream::python
