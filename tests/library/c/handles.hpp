// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include <boxstream/boxstream.h>

#include <gtest/gtest.h>

/// Handles of C that end by themselves, and what can be seen of them.
namespace boxstream::c_test {

struct Destroy {
  void operator()(boxstream_world* world) const { boxstream_world_destroy(world); }
  void operator()(boxstream_detector* detector) const { boxstream_detector_destroy(detector); }
};
using World = std::unique_ptr<boxstream_world, Destroy>;
using Detector = std::unique_ptr<boxstream_detector, Destroy>;

template <class S>
constexpr boxstream_scalar scalar_of = std::is_same_v<S, float> ? BOXSTREAM_FLOAT : BOXSTREAM_DOUBLE;

template <class S>
using Box = std::array<S, 6>;

template <class S>
boxstream_boxes view_of(const std::vector<Box<S>>& boxes) {
  return {scalar_of<S>, boxes.data(), boxes.size(), nullptr};
}

inline Detector make_detector(const boxstream_executor* executor = nullptr) {
  boxstream_detector* detector = nullptr;
  EXPECT_EQ(boxstream_detector_create(executor, &detector), BOXSTREAM_OK);
  return Detector(detector);
}

/// With these boxes, whose users are 0, 1, 2 ...
template <class S>
World make_world(const std::vector<Box<S>>& boxes, std::vector<boxstream_id>& ids) {
  boxstream_world* world = nullptr;
  EXPECT_EQ(boxstream_world_create(scalar_of<S>, nullptr, &world), BOXSTREAM_OK);
  ids.resize(boxes.size());
  std::vector<std::uint64_t> users;
  for (std::size_t i = 0; i < boxes.size(); ++i) users.push_back(i);
  const boxstream_boxes view = view_of(boxes);
  EXPECT_EQ(boxstream_world_insert(world, &view, users.data(), ids.data()), BOXSTREAM_OK);
  return World(world);
}

/// A visitor of C that calls a function of C++, which `user` points to.
template <class Function>
bool visit_by(void* user, boxstream_id id) {
  return (*static_cast<Function*>(user))(id);
}

template <class Function>
boxstream_status query_box(const World& world, const Box<double>& box, Function function) {
  return boxstream_world_query_box(world.get(), box.data(), visit_by<Function>, &function);
}

template <class Function>
boxstream_status query_ray(const World& world, const double* origin, const double* direction, double length,
                           Function function) {
  const auto visit = [](void* user, boxstream_id id, double enter, double rest) {
    return (*static_cast<Function*>(user))(id, enter, rest);
  };
  return boxstream_world_query_ray(world.get(), origin, direction, length, visit, &function);
}

template <class Function>
boxstream_status query_near(const World& world, const Box<double>& box, double limit, Function function) {
  const auto visit = [](void* user, boxstream_id id, double distance) {
    return (*static_cast<Function*>(user))(id, distance);
  };
  return boxstream_world_query_near(world.get(), box.data(), limit, visit, &function);
}

template <class Function>
boxstream_status near_pairs(const World& world, double limit, Function function) {
  const auto visit = [](void* user, boxstream_id_pair pair, double distance) {
    return (*static_cast<Function*>(user))(pair, distance);
  };
  return boxstream_world_near_pairs(world.get(), limit, visit, &function);
}

/// What can be seen of a world, in numbers.
inline std::vector<std::uint64_t> state_of(const World& world, const std::vector<boxstream_id>& ids) {
  std::vector<std::uint64_t> all{boxstream_world_size(world.get()), boxstream_world_pair_count(world.get())};
  const auto add_id = [&](boxstream_id id) { all.insert(all.end(), {id.slot, id.generation}); };
  const auto add_pairs = [&](const boxstream_id_pair* pairs, std::size_t count) {
    all.push_back(count);
    for (std::size_t i = 0; i < count; ++i) add_id(pairs[i].a), add_id(pairs[i].b);
    return true;
  };
  std::size_t count = 0;
  const boxstream_id_pair* const begun = boxstream_world_begun(world.get(), &count);
  add_pairs(begun, count);
  const boxstream_id_pair* const ended = boxstream_world_ended(world.get(), &count);
  add_pairs(ended, count);
  boxstream_world_stream_pairs(
      world.get(),
      [](void* user, const boxstream_id_pair* pairs, std::size_t size) {
        return (*static_cast<decltype(add_pairs)*>(user))(pairs, size);
      },
      const_cast<void*>(static_cast<const void*>(&add_pairs)));
  for (const boxstream_id id : ids) {
    all.push_back(boxstream_world_contains(world.get(), id));
    all.push_back(boxstream_world_user(world.get(), id));
  }
  for (double x = -8; x < 8; x += 0.25)  // where boxes are
    query_box(world, {x, -100, -100, x, 100, 100}, [&](boxstream_id id) {
      add_id(id);
      return true;
    });
  return all;
}

}  // namespace boxstream::c_test
