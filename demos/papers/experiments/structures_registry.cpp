// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "papers/experiments/structures.hpp"

namespace boxstream::papers {

namespace {

[[noreturn]] void cannot() {
  throw std::logic_error("a structure was asked for what is not among its works");
}

}  // namespace

void Structure::query_box(const Aabb&, VisitNumber) const {
  cannot();
}
FirstHit Structure::first_hit(const Ray&) const {
  cannot();
}
void Structure::insert(std::uint32_t, const Aabb&) {
  cannot();
}
void Structure::erase(std::uint32_t) {
  cannot();
}
void Structure::find_pairs(Span<const Aabb>, Found) const {
  cannot();
}
void Structure::next_frame(Span<const Aabb>, Found) {
  cannot();
}

}  // namespace boxstream::papers
