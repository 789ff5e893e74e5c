// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/ray.hpp>
#include <boxstream/span.hpp>

#include "papers/hybrid/problem.hpp"
#include "papers/structures/first_hit.hpp"

/// What `boxstream paper structures` compares: anything that holds boxes and answers about them. To add one, write a
/// Structure and add it to the list at the end of its file or of structures.cpp.
namespace boxstream::papers {

/// What a structure may do once it is built, and so what is measured.
enum Work : unsigned {
  box_work = 1,     ///< query_box
  ray_work = 2,     ///< first_hit
  update_work = 4,  ///< insert and erase
  pair_work = 8,    ///< find_pairs
  frame_work = 16,  ///< next_frame
  point_work = 32,  ///< query_box, where all boxes built are points; box_work comprises it
  no_build = 64,    ///< not a work: there is nothing to build
};

using VisitNumber = FunctionRef<void(std::uint32_t number)>;

/// Boxes are closed, valid and finite, and known by numbers. All calls are timed as they are: what a structure makes on
/// the way is part of its price. What is not among the works of its entry (below) is never called,
/// and need not be there.
class Structure {
 public:
  virtual ~Structure() = default;

  /// In place of all that was there; boxes[i] has the number i.
  virtual void build(Span<const Aabb> boxes) = 0;

  /// Numbers of the boxes that touch `box`, each once, in any order.
  virtual void query_box(const Aabb&, VisitNumber) const { cannot(); }

  /// By `ray_enter`. Rays are plain (no extents); directions may have zeros in them.
  virtual FirstHit first_hit(const Ray&) const { cannot(); }

  /// `number` is not in use; numbers stay below twice the number of boxes that there are at most.
  virtual void insert(std::uint32_t, const Aabb&) { cannot(); }
  virtual void erase(std::uint32_t) { cannot(); }

  /// Touching pairs of a box that was built and a box of `others`: its number and its place there. What has to be built
  /// over `others` is built in here.
  virtual void find_pairs(Span<const Aabb>, Found) const { cannot(); }

  /// All boxes replaced by those of the next frame, most of them close to where they were; then all touching pairs
  /// among them, each once, in any order, the smaller number first.
  virtual void next_frame(Span<const Aabb>, Found) { cannot(); }

 private:
  [[noreturn]] static void cannot() { throw std::logic_error("not among the works of this structure"); }
};

struct StructureEntry {
  std::string_view name;
  unsigned works;  ///< of Work, or-ed
  std::unique_ptr<Structure> (*make)();
};

template <class T>
std::unique_ptr<Structure> make_structure() {
  return std::make_unique<T>();
}

/// In the order in which tables show them. The engine comes first and says what the answers are.
Span<const StructureEntry> structures();

}  // namespace boxstream::papers
