// SPDX-License-Identifier: MIT
// Robots among objects, as MoveIt and Tesseract query them.
#include <cmath>
#include <functional>

#include "users/fcl_user.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t links = 60;

struct Random {
  std::mt19937_64 engine;
  double operator()(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); }
  FclVector vector(double from, double to) { return {(*this)(from, to), (*this)(from, to), (*this)(from, to)}; }
};

/// A room twice as wide as it is high.
double side_of_room(std::size_t n) {
  return 1.2 * std::cbrt(static_cast<double>(n));
}

void fill_room(FclThings& room, std::size_t n, std::uint64_t seed, double reach) {
  Random random{std::mt19937_64(seed)};
  const double side = side_of_room(n);
  for (std::size_t i = 0; i < n; ++i) {
    const FclVector at(random(-side, side), random(-side, side), random(0, side));
    room.add(at, random.vector(0.05, 0.45), reach);
  }
}

/// A chain that goes up from `base`, `step` a link.
void add_robot(FclThings& robot, std::size_t count, const FclVector& base, double step, std::uint64_t seed,
               double reach) {
  Random random{std::mt19937_64(seed + 7)};
  FclVector at = base;
  for (std::size_t i = 0; i < count; ++i) {
    robot.add(at, FclVector(random(0.05, 0.1), random(0.05, 0.1), random(0.05, 0.15)), reach);
    at += FclVector(random(-0.15, 0.15), random(-0.15, 0.15), step);
  }
}

/// The links of a robot in each of the states along a path, one after another.
struct Path {
  static constexpr int states = 8;
  FclThings robots[states];

  Path(std::size_t count, const FclVector& base, double step, std::uint64_t seed) {
    for (FclThings& robot : robots) add_robot(robot, count, base, step, seed, 0);
  }
  void go_to(int frame) {
    for (int state = 0; state < states; ++state) robots[state].sway(frame * states + state, 0.02);
  }
};

/// MoveIt's checks of a robot's states against the room: link by link.
class RoomUser final : public FclUser {
 public:
  using Ask = std::function<void(FclManager&, ::fcl::CollisionObject<double>*, FclAsked&)>;

  RoomUser(std::size_t n, std::uint64_t seed, bool is_clear, Ask ask)
      : path_(links, {0, 0, is_clear ? 1.5 * side_of_room(n) + 1 : 0}, 0.1, seed), ask_(std::move(ask)) {
    fill_room(room_, n, seed, 0);
  }
  void go_to(int frame) override { path_.go_to(frame); }
  std::unique_ptr<FclUse> open(const FclManagerKind& kind) override { return std::make_unique<Use>(*this, kind); }

 private:
  struct Use final : FclUse {
    Use(RoomUser& of, const FclManagerKind& kind) : user(of), manager(filled(kind, of.room_)) {}
    void run(FclAsked& asked) override {
      for (FclThings& robot : user.path_.robots)
        for (auto* const link : robot.pointers) {
          user.ask_(*manager, link, asked);
          ++asked.groups;
        }
    }
    RoomUser& user;
    std::unique_ptr<FclManager> manager;
  };

  FclThings room_;
  Path path_;
  Ask ask_;
};

template <auto Callback>
void collide(FclManager& manager, ::fcl::CollisionObject<double>* link, FclAsked& asked) {
  manager.collide(link, &asked, Callback);
}

template <auto Callback>
void distance(FclManager& manager, ::fcl::CollisionObject<double>* link, FclAsked& asked) {
  manager.distance(link, &asked, Callback);
  asked.note_least();
}

template <auto Ask, bool is_clear = false>
std::unique_ptr<FclUser> room_user(const FclUserCase&, std::size_t n, std::uint64_t seed) {
  return std::make_unique<RoomUser>(n, seed, is_clear, Ask);
}

/// MoveIt's self checks: a new manager for each state, and gone after one query.
template <bool is_distance>
class SelfUser final : public FclUser {
 public:
  SelfUser(const FclUserCase&, std::size_t n, std::uint64_t seed) : path_(n, {0, 0, 0}, 0.2, seed) {}
  void go_to(int frame) override { path_.go_to(frame); }
  std::unique_ptr<FclUse> open(const FclManagerKind& kind) override { return std::make_unique<Use>(*this, kind); }

 private:
  struct Use final : FclUse {
    Use(SelfUser& of, const FclManagerKind& of_kind) : user(of), kind(of_kind) {}
    void run(FclAsked& asked) override {
      for (const FclThings& robot : user.path_.robots) {
        const std::unique_ptr<FclManager> manager = filled(kind, robot);
        if (is_distance) {
          manager->distance(&asked, on_distance_of_links);
          asked.note_least();
        } else {
          manager->collide(&asked, on_contact_of_links);
        }
        ++asked.groups;
      }
    }
    SelfUser& user;
    const FclManagerKind& kind;
  };

  Path path_;
};

/// Tesseract's two managers, with boxes that are larger by a margin; the links that moved are passed as a list.
class TesseractUser final : public FclUser {
 public:
  TesseractUser(const FclUserCase&, std::size_t n, std::uint64_t seed) {
    constexpr double reach = 0.025;
    fill_room(room_, n, seed, reach);
    add_robot(robot_, links, {0, 0, 0}, 0.1, seed, reach);
  }
  void go_to(int frame) override { robot_.sway(frame, 0.02); }
  std::unique_ptr<FclUse> open(const FclManagerKind& kind) override { return std::make_unique<Use>(*this, kind); }

 private:
  struct Use final : FclUse {
    Use(TesseractUser& of, const FclManagerKind& kind)
        : user(of), still(filled(kind, of.room_)), moving(filled(kind, of.robot_)) {}
    void run(FclAsked& asked) override {
      moving->update(user.robot_.pointers);
      still->collide(moving.get(), &asked, on_contact);
      ++asked.groups;
      moving->collide(&asked, on_contact_of_links);
    }
    TesseractUser& user;
    std::unique_ptr<FclManager> still, moving;
  };

  FclThings room_, robot_;
};

template <class User>
std::unique_ptr<FclUser> make(const FclUserCase& of, std::size_t n, std::uint64_t seed) {
  return std::make_unique<User>(of, n, seed);
}

}  // namespace

std::vector<FclUserCase> fcl_robot_cases() {
  const std::vector<std::size_t> rooms{3, 10, 100, 1000, 10000}, robots{5, 10, 30, 60, 120};
  return {
      {"moveit:collide", "60 links of 8 states, each asked for all objects that it touches", rooms,
       room_user<collide<on_contact>>},
      {"moveit:first", "the same, the first one will do", rooms, room_user<collide<on_first_contact>>},
      {"moveit:distance", "their least distances, by limits that shrink", rooms, room_user<distance<on_distance>>},
      {"moveit:unset", "the same, but the limit is never set", rooms, room_user<distance<on_distance_without_limit>>,
       ~std::size_t{0}},
      {"moveit:clear", "all that links touch, far from the room", rooms, room_user<collide<on_contact>, true>},
      {"moveit:far", "least distances, far from the room", rooms, room_user<distance<on_distance>, true>},
      {"moveit:self", "a robot of n links in 8 states, a new manager each, and all pairs", robots,
       make<SelfUser<false>>},
      {"moveit:self-near", "the same, and the least distance", robots, make<SelfUser<true>>, 4},
      {"tesseract:contact", "60 links moved, by a list; with n static objects and each other", rooms,
       make<TesseractUser>},
  };
}

}  // namespace boxstream::bench
