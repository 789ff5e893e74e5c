// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "simulation/query/courses.hpp"

namespace boxstream::query {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double radians = std::numbers::pi / 180;

/// The digits of `index` in `base`, mirrored at the point.
double halton(std::uint64_t index, std::uint64_t base) {
  double value = 0, digit = 1;
  for (; index > 0; index /= base) {
    digit /= static_cast<double>(base);
    value += digit * static_cast<double>(index % base);
  }
  return value;
}

class ScatterCourse final : public Course {
 public:
  ScatterCourse(const Scatter& scatter, scenes::Random random) : scatter_(scatter) {
    double weights = 0;
    for (const MixEntry& entry : scatter.mix) weights += entry.weight;
    for (int i = 0; i < scatter.count; ++i) {
      double drawn = random.unit() * weights;
      std::size_t choice = 0;
      while (choice + 1 < scatter.mix.size() && drawn >= scatter.mix[choice].weight)
        drawn -= scatter.mix[choice++].weight;
      const auto index = static_cast<std::uint64_t>(i);
      parts_.push_back({scatter.mix[choice].shape, static_cast<std::uint32_t>(i), 0, 0, ""});
      Body body;
      const Vec3& s = scatter.size;
      body.home = vec(scatter.origin) + Vector3d((halton(index + 1, 2) - 0.5) * s[0], halton(index + 1, 3) * s[1],
                                                 (halton(index + 1, 5) - 0.5) * s[2]);
      const scenes::Quat q = scatter.turned ? random.rotation() : scenes::Quat{0, 0, 0, 1};
      body.turn = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
      body.direction = vec(random.in_ball(1));
      body.phase = random.range(0, 2 * std::numbers::pi);
      body.pace = random.range(0.02, 0.1);
      bodies_.push_back(body);
    }
  }

  bool moves() const override { return scatter_.shake > 0 || scatter_.degrees != 0; }

  void place(std::uint64_t step, Pose* out) const override {
    for (const Body& body : bodies_) {
      const double swing = std::sin(body.phase + body.pace * static_cast<double>(step));
      *out = pose_at(body.home + body.direction * (scatter_.shake * swing));
      const AngleAxisd turn(scatter_.degrees * radians * swing,
                            Vector3d(body.direction.z(), 1, body.direction.x()).normalized());
      out->linear() = turn * body.turn;
      ++out;
    }
  }

 private:
  struct Body {
    Vector3d home, direction;
    Eigen::Matrix3d turn;
    double phase, pace;
  };

  Scatter scatter_;
  std::vector<Body> bodies_;
};

class BinCourse final : public Course {
 public:
  BinCourse(const Bin& bin, Shapes& shapes) {
    const double t = bin.thickness / 2;
    const Vector3d half = vec(bin.size) / 2, floor = vec(bin.origin);
    const auto add = [&](const Vector3d& size, const Vector3d& centre) {
      parts_.push_back({added(shapes, scenes::BoxShape{{size.x(), size.y(), size.z()}}), 0,
                        static_cast<int>(parts_.size()), 5, "wall"});
      poses_.push_back(pose_at(floor + centre));
    };
    add({half.x() + 2 * t, t, half.z() + 2 * t}, {0, -t, 0});
    for (const double side : {-1.0, 1.0}) {
      add({t, half.y(), half.z()}, {side * (half.x() + t), half.y(), 0});
      add({half.x() + 2 * t, half.y(), t}, {0, half.y(), side * (half.z() + t)});
    }
  }

  bool moves() const override { return false; }
  void place(std::uint64_t, Pose* out) const override { std::copy(poses_.begin(), poses_.end(), out); }

 private:
  std::vector<Pose> poses_;
};

}  // namespace

std::unique_ptr<Course> make_course(const Scatter& scatter, Shapes&, scenes::Random random) {
  return std::make_unique<ScatterCourse>(scatter, random);
}

std::unique_ptr<Course> make_course(const Bin& bin, Shapes& shapes, scenes::Random) {
  return std::make_unique<BinCourse>(bin, shapes);
}

}  // namespace boxstream::query
