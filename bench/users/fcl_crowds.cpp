// SPDX-License-Identifier: MIT
// A crowd of objects that hardly changes, as python-fcl, trimesh and MoveIt ask about it one object at a time.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "users/fcl_user.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t others = 20;

/// Boxes near the places of a grid that has more of them than there are boxes, in no order.
class CrowdUser final : public FclUser {
 public:
  CrowdUser(const FclUserCase& of, std::size_t n, std::uint64_t seed)
      : inside_(of.name == "crowd:inside"),
        self_(of.name == "crowd:self"),
        moves_(of.name.substr(0, 5) == "moved"),
        touches_(of.name == "moved:touch") {
    std::mt19937_64 engine(seed);
    const auto random = [&](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(engine);
    };
    const auto row = static_cast<std::size_t>(std::ceil(std::cbrt(1.3 * static_cast<double>(n))));
    std::vector<std::size_t> cells(row * row * row);
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = i;
    std::shuffle(cells.begin(), cells.end(), engine);
    const auto jitter = [&] { return FclVector(random(-0.25, 0.25), random(-0.25, 0.25), random(-0.25, 0.25)); };
    for (std::size_t i = 0; i < n; ++i) {
      const FclVector cell(static_cast<double>(cells[i] % row), static_cast<double>(cells[i] / row % row),
                           static_cast<double>(cells[i] / row / row));
      crowd_.add((1.1 * cell + jitter()).eval(), FclVector(random(0.1, 0.3), random(0.1, 0.3), random(0.1, 0.3)));
    }
    const double side = 1.1 * static_cast<double>(row);
    for (std::size_t i = 0; i < others; ++i) {
      const FclVector at = inside_ ? FclVector(random(0, side), random(0, side), random(0, side))
                                   : FclVector(random(-2.5, -1), random(-2.5, -1), random(-2.5, -1));
      others_.add(at, FclVector(0.15, 0.2, 0.15));
    }
  }
  void go_to(int frame) override {
    others_.sway(frame, 0.1);
    if (moves_) crowd_.sway(frame, 0.02);
  }
  std::unique_ptr<FclUse> open(const FclManagerKind& kind) override { return std::make_unique<Use>(*this, kind); }

 private:
  struct Use final : FclUse {
    Use(CrowdUser& of, const FclManagerKind& kind) : user(of), manager(filled(kind, of.crowd_)) {}
    void run(FclAsked& asked) override {
      for (std::size_t i = 0; i < user.others_.all.size(); ++i) {
        if (user.self_) {
          manager->distance(&asked, on_distance);
        } else if (user.moves_) {
          auto* const moved = user.crowd_.pointers[next++ * 7 % user.crowd_.pointers.size()];
          manager->unregisterObject(moved);
          if (!user.touches_) manager->distance(moved, &asked, on_distance);
          manager->registerObject(moved);
          if (user.touches_) manager->collide(user.others_.pointers[i], &asked, on_contact);
        } else {
          manager->distance(user.others_.pointers[i], &asked, on_distance);
        }
        if (!user.touches_) asked.note_least();
        ++asked.groups;
      }
    }
    CrowdUser& user;
    std::unique_ptr<FclManager> manager;
    std::size_t next = 0;
  };

  bool inside_, self_, moves_, touches_;
  FclThings crowd_, others_;
};

std::unique_ptr<FclUser> make(const FclUserCase& of, std::size_t n, std::uint64_t seed) {
  return std::make_unique<CrowdUser>(of, n, seed);
}

}  // namespace

std::vector<FclUserCase> fcl_crowd_cases() {
  const std::vector<std::size_t> sizes{5, 12, 40, 80, 1500, 6000};
  return {
      {"crowd:outside", "the least distance of 20 objects beside n that rest", sizes, make, 0, 0, true},
      {"crowd:inside", "the same from among them", sizes, make, 0, 0, true},
      {"crowd:self", "the least distance of two of n that rest, 20 times", sizes, make, 0, 0, true},
      {"moved:touch", "20 of n taken out and put in again, each followed by what touches another one", sizes, make, 0,
       0, true},
      {"moved:distance", "20 of n taken out, asked for their least distance, and put in again", sizes, make, 0, 0,
       true},
  };
}

}  // namespace boxstream::bench
