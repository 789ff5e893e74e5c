// SPDX-License-Identifier: MIT
// Bodies that move: Drake's frames, and bins from which a gripper takes parts.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "users/fcl_user.hpp"

namespace boxstream::bench {

namespace {

/// Parts that lie side by side without meeting; the boxes of long ones touch their neighbours. On z >= 0.
void add_parts(FclThings& parts, std::size_t n, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto random = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); };
  constexpr double pitch = 0.7;
  const auto row = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(n)) - 1e-9));
  std::vector<std::size_t> cells(row * row * row);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = i;
  // From below, and in no order.
  std::shuffle(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(n), engine);
  for (std::size_t i = 0; i < n; ++i) {
    const FclVector cell(static_cast<double>(cells[i] % row), static_cast<double>(cells[i] / row % row),
                         static_cast<double>(cells[i] / row / row));
    FclVector half(random(0.12, 0.3), random(0.12, 0.3), random(0.12, 0.3));
    half[static_cast<int>(engine() % 3)] = random(0.3, 0.6);
    parts.add(pitch * cell + FclVector(random(-0.03, 0.03), random(-0.03, 0.03), 0.4 + random(-0.03, 0.03)), half);
  }
}

/// Drake's engine: all that move in one manager, all that never do in another. In each frame all have moved; the
/// queries are for pairs of the first set and pairs of both.
class DrakeUser final : public FclUser {
 public:
  DrakeUser(const FclUserCase& of, std::size_t n, std::uint64_t seed)
      : contacts_(of.name == "drake:contact"), self_(of.name != "drake:anchored") {
    add_parts(moving_, n, seed);
    std::mt19937_64 engine(seed + 1);
    const double side = 0.7 * std::cbrt(static_cast<double>(n));
    const auto random = [&](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(engine);
    };
    anchored_.add();
    for (int i = 0; i < 50; ++i)
      anchored_.add(FclVector(random(-1, side), random(-1, side), random(-1, side)),
                    FclVector(random(0.1, 0.4), random(0.1, 0.4), random(0.1, 0.4)));
  }
  void go_to(int frame) override { moving_.sway(frame, 0.02); }
  std::unique_ptr<FclUse> open(const FclManagerKind& kind) override { return std::make_unique<Use>(*this, kind); }

 private:
  struct Use final : FclUse {
    Use(DrakeUser& of, const FclManagerKind& kind)
        : user(of), moving(filled(kind, of.moving_)), anchored(filled_one_by_one(kind, of.anchored_)) {}
    void run(FclAsked& asked) override {
      moving->update();
      if (user.contacts_) {
        moving->collide(&asked, on_contact);
        ++asked.groups;
        moving->collide(anchored.get(), &asked, on_contact);
        return;
      }
      if (user.self_) moving->distance(&asked, on_distance_up_to_constant);
      ++asked.groups;
      moving->distance(anchored.get(), &asked, on_distance_up_to_constant);
    }
    DrakeUser& user;
    std::unique_ptr<FclManager> moving, anchored;
  };

  bool contacts_, self_;
  FclThings moving_, anchored_;
};

/// Drake's frames where most of the world is anchored and little is awake: pairs of both that are near.
class AwakeUser final : public FclUser {
 public:
  AwakeUser(const FclUserCase& of, std::size_t n, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    const double room = 0.26 * std::cbrt(static_cast<double>(of.others));
    const auto random = [&](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(engine);
    };
    const auto anywhere = [&] { return FclVector(random(-room, room), random(-room, room), random(-room, room)); };
    for (std::size_t i = 0; i < of.others; ++i)
      anchored_.add(anywhere(), FclVector(random(0.06, 0.4), random(0.06, 0.4), random(0.06, 0.4)));
    for (std::size_t i = 0; i < n; ++i) awake_.add(anywhere(), FclVector(0.2, 0.2, 0.2));
  }
  void go_to(int frame) override { awake_.sway(frame, 0.05); }
  std::unique_ptr<FclUse> open(const FclManagerKind& kind) override { return std::make_unique<Use>(*this, kind); }

 private:
  struct Use final : FclUse {
    Use(AwakeUser& of, const FclManagerKind& kind)
        : awake(filled_one_by_one(kind, of.awake_)), anchored(filled(kind, of.anchored_)) {}
    void run(FclAsked& asked) override {
      awake->update();
      awake->distance(anchored.get(), &asked, on_distance_up_to_constant);
    }
    std::unique_ptr<FclManager> awake, anchored;
  };

  FclThings awake_, anchored_;
};

/// A bin. Parts settle, or a few are moved one by one; a gripper of 20 fingers and pads may reach into it.
class BinUser final : public FclUser {
 public:
  BinUser(const FclUserCase& of, std::size_t n, std::uint64_t seed)
      : distances_(of.name == "bin:near"), gripper_(of.name == "bin:gripper"), few_(of.name == "bin:few" || gripper_) {
    add_parts(parts_, n, seed);
    const double side = 0.35 * std::cbrt(static_cast<double>(n));
    for (int i = 0; i < 20; ++i)
      fingers_.add(FclVector(side + 0.1 * (i % 4), side + 0.1 * (i / 4), side + 0.2 * (i % 5)),
                   FclVector(0.03, 0.03, 0.12));
    for (std::size_t i = 0; i < 10; ++i) moved_.push_back(&parts_.all[i * n / 10]);
  }
  void go_to(int frame) override {
    fingers_.sway(frame, 0.1);
    parts_.sway(few_ ? 0 : frame, 0.02);
    if (!few_) return;
    for (std::size_t i = 0; i < moved_.size(); ++i)
      moved_[i]->place(moved_[i]->home() + 0.02 * FclVector(std::sin(frame + i), std::sin(2.0 * frame), 0));
  }
  std::unique_ptr<FclUse> open(const FclManagerKind& kind) override { return std::make_unique<Use>(*this, kind); }

 private:
  struct Use final : FclUse {
    Use(BinUser& of, const FclManagerKind& kind) : user(of), manager(filled(kind, of.parts_)) {}
    void run(FclAsked& asked) override {
      if (user.few_)
        for (FclThing* const part : user.moved_) manager->update(part);
      else
        manager->update();
      if (user.gripper_) {
        for (auto* const finger : user.fingers_.pointers) {
          manager->collide(finger, &asked, on_contact);
          manager->distance(finger, &asked, on_distance);
          asked.note_least();
          ++asked.groups;
        }
      } else if (user.distances_) {
        manager->distance(&asked, on_distance);
        asked.note_least();
      } else {
        manager->collide(&asked, on_contact);
      }
    }
    BinUser& user;
    std::unique_ptr<FclManager> manager;
  };

  bool distances_, gripper_, few_;
  FclThings parts_, fingers_;
  std::vector<FclThing*> moved_;
};

template <class User>
std::unique_ptr<FclUser> make(const FclUserCase& of, std::size_t n, std::uint64_t seed) {
  return std::make_unique<User>(of, n, seed);
}

}  // namespace

std::vector<FclUserCase> fcl_body_cases() {
  const std::vector<std::size_t> sizes{10, 100, 1000, 10000, 30000}, awake{1, 10, 70, 1000};
  return {
      {"drake:near", "n moved bodies, pairs nearer than 0.1 with each other and 50 anchored ones on a half-space",
       sizes, make<DrakeUser>},
      {"drake:anchored", "the same, only with the anchored ones", sizes, make<DrakeUser>},
      {"drake:awake10k", "n scattered bodies, all moved, pairs nearer than 0.1 with 10 000 anchored ones", awake,
       make<AwakeUser>, 0, 10000, true},
      {"drake:awake100k", "the same beside 100 000 anchored ones", awake, make<AwakeUser>, 0, 100000, true},
      {"drake:contact", "the same bodies, pairs that touch, with each other and the anchored ones", sizes,
       make<DrakeUser>},
      {"bin:near", "n parts, all moved, the least distance of two", sizes, make<BinUser>},
      {"bin:contact", "n parts, all moved, pairs that touch", sizes, make<BinUser>},
      {"bin:few", "10 of n parts moved one by one, pairs that touch", sizes, make<BinUser>},
      {"bin:gripper", "the same parts moved; what 20 links of a gripper touch, and how far they are", sizes,
       make<BinUser>},
  };
}

}  // namespace boxstream::bench
