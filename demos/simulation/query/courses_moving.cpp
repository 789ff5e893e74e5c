// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "simulation/query/courses.hpp"

namespace boxstream::query {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
constexpr int all_links = 1'000'000;

class GripperCourse final : public Course {
 public:
  GripperCourse(const Gripper& gripper, Shapes& shapes) : gripper_(gripper) {
    const double s = gripper.size;
    parts_.push_back({added(shapes, scenes::BoxShape{{s / 2, s / 8, s / 2}}), 0, 0, all_links, "palm"});
    const std::size_t finger = added(shapes, scenes::CapsuleShape{s / 12, s});
    for (int i = 1; i <= gripper.fingers; ++i) parts_.push_back({finger, 0, i, all_links, "finger"});
  }

  bool moves() const override { return true; }

  void place(std::uint64_t step, Pose* out) const override {
    const double t = static_cast<double>(step) / gripper_.leg;
    Pose palm = pose_at(on_path(t));
    palm.rotate(AngleAxisd(gripper_.degrees * pi / 180 * static_cast<double>(step), Vector3d::UnitY()));
    *out++ = palm;
    const double s = gripper_.size, open = s * (0.35 + 0.15 * std::cos(2 * pi * t));
    for (int i = 0; i < gripper_.fingers; ++i) {
      const double angle = 2 * pi * i / gripper_.fingers;
      *out++ = palm * pose_at({open * std::cos(angle), -0.6 * s, open * std::sin(angle)});
    }
  }

 private:
  /// To the last waypoint and back again, for ever.
  Vector3d on_path(double t) const {
    const auto legs = static_cast<double>(gripper_.path.size() - 1);
    if (legs == 0) return vec(gripper_.path[0]);
    const double there_and_back = std::fmod(t, 2 * legs);
    const double at = there_and_back <= legs ? there_and_back : 2 * legs - there_and_back;
    const auto leg = std::min(static_cast<std::size_t>(at), gripper_.path.size() - 2);
    const double share = at - static_cast<double>(leg);
    return (1 - share) * vec(gripper_.path[leg]) + share * vec(gripper_.path[leg + 1]);
  }

  Gripper gripper_;
};

class ArmCourse final : public Course {
 public:
  ArmCourse(const Arm& arm, Shapes& shapes, scenes::Random random) : arm_(arm) {
    const std::size_t link = added(shapes, scenes::CapsuleShape{arm.radius, arm.length});
    for (int i = 0; i < arm.links; ++i) {
      parts_.push_back({link, 0, i, 1, "link"});
      phases_.push_back(random.range(0, 2 * pi));
    }
    const double tool = 1.5 * arm.radius;
    parts_.push_back({added(shapes, scenes::BoxShape{{tool, tool / 2, tool}}), 0, arm.links, 1, "tool"});
  }

  bool moves() const override { return true; }

  void place(std::uint64_t step, Pose* out) const override {
    Pose joint = pose_at(vec(arm_.base));
    for (int i = 0; i < arm_.links; ++i) {
      const double turns = static_cast<double>(step) / arm_.period * (1 + 0.3 * i);
      const double angle = arm_.degrees * pi / 180 * std::sin(2 * pi * turns + phases_[static_cast<std::size_t>(i)]);
      // Shoulder and elbow bend, every third joint twists.
      joint.rotate(AngleAxisd(angle, i % 3 == 0   ? Vector3d::UnitY()
                                     : i % 3 == 1 ? Vector3d::UnitZ()
                                                  : Vector3d::UnitX()));
      *out++ = joint * pose_at({0, arm_.length / 2, 0});
      joint.translate(Vector3d(0, arm_.length, 0));
    }
    *out = joint;
  }

 private:
  Arm arm_;
  std::vector<double> phases_;
};

class ConvoyCourse final : public Course {
 public:
  ConvoyCourse(const Convoy& convoy, Shapes& shapes, scenes::Random random) : convoy_(convoy) {
    const std::size_t trailer = added(shapes, scenes::BoxShape{{5, 1.4, 1.25}});
    const std::size_t cabin = added(shapes, scenes::BoxShape{{1, 1.1, 1.2}});
    const std::size_t wheel = added(shapes, scenes::CylinderShape{0.5, 0.3});
    for (int i = 0; i < convoy.vehicles; ++i) {
      const auto body = static_cast<std::uint32_t>(i);
      parts_.push_back({trailer, body, 0, all_links, "trailer"});
      parts_.push_back({cabin, body, 1, all_links, "cabin"});
      for (int w = 2; w < 2 + wheels; ++w) parts_.push_back({wheel, body, w, all_links, "wheel"});
      phases_.push_back(random.range(0, 2 * pi));
      paces_.push_back(random.range(0.01, 0.05));
    }
  }

  bool moves() const override { return true; }

  void place(std::uint64_t step, Pose* out) const override {
    const int columns = (convoy_.vehicles + convoy_.lanes - 1) / convoy_.lanes;
    const double pitch = length + convoy_.gap, road = columns * pitch;
    for (int i = 0; i < convoy_.vehicles; ++i) {
      const auto v = static_cast<std::size_t>(i);
      const int lane = i % convoy_.lanes;
      const double course = lane % 2 == 0 ? 1 : -1, t = static_cast<double>(step);
      const double drift = convoy_.sway * std::sin(phases_[v] + paces_[v] * t);
      double along = std::fmod(i / convoy_.lanes * pitch + convoy_.speed * t + drift, road);
      if (along < 0) along += road;
      Pose vehicle = pose_at({course * (along - road / 2), 0, (lane - (convoy_.lanes - 1) / 2.0) * convoy_.lane_width});
      if (course < 0) vehicle.rotate(AngleAxisd(pi, Vector3d::UnitY()));
      *out++ = vehicle * pose_at({-1, 2, 0});
      *out++ = vehicle * pose_at({5.2, 1.6, 0});
      for (int w = 0; w < wheels; ++w) {
        Pose wheel = vehicle * pose_at({wheel_at[w / 2], 0.5, w % 2 == 0 ? -1.0 : 1.0});
        wheel.rotate(AngleAxisd(pi / 2, Vector3d::UnitX()));  // from y to the axle
        *out++ = wheel;
      }
    }
  }

 private:
  static constexpr int wheels = 6;
  static constexpr double wheel_at[] = {-5, -3, 5};
  static constexpr double length = 12.2;

  Convoy convoy_;
  std::vector<double> phases_, paces_;
};

}  // namespace

std::unique_ptr<Course> make_course(const Gripper& gripper, Shapes& shapes, scenes::Random) {
  return std::make_unique<GripperCourse>(gripper, shapes);
}

std::unique_ptr<Course> make_course(const Arm& arm, Shapes& shapes, scenes::Random random) {
  return std::make_unique<ArmCourse>(arm, shapes, random);
}

std::unique_ptr<Course> make_course(const Convoy& convoy, Shapes& shapes, scenes::Random random) {
  return std::make_unique<ConvoyCourse>(convoy, shapes, random);
}

}  // namespace boxstream::query
