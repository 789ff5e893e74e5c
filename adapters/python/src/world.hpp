// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "arrays.hpp"
#include "executor.hpp"
#include "signals.hpp"
#include "usage.hpp"

namespace boxstream::python {

/// A World of float32 or float64 whose calls take and give arrays.
class PyWorld {
 public:
  /// `options` without an executor.
  PyWorld(py::handle dtype, py::handle executor, WorldOptions options);

  Scalar scalar() const { return worlds_.index() == 0 ? Scalar::float32 : Scalar::float64; }

  py::array create(py::handle boxes, py::handle groups, py::handle masks, py::handle users, py::handle invalid);
  std::size_t move(py::handle ids, py::handle boxes, py::handle invalid);
  std::size_t destroy(py::handle ids);
  std::size_t set_filters(py::handle ids, py::handle groups, py::handle masks);
  void clear();
  WorldStats update();

  std::size_t size();
  py::array contains(py::handle ids);
  py::array boxes(py::handle ids);
  py::array users(py::handle ids);
  py::array bounds();
  py::array begun();
  py::array ended();
  py::array pairs();

  py::tuple query_boxes(py::handle boxes);
  py::tuple query_rays(py::handle origins, py::handle directions, py::handle lengths);
  py::tuple cast_rays(py::handle origins, py::handle directions, py::handle lengths);
  py::array query_nearest(py::handle points, py::handle count);

 private:
  /// `use(world)` for a search or a change, alone in this world and without the interpreter's lock.
  template <class Use>
  auto change(Use use) {
    const Usage::Change change(usage_);
    return without_lock([&](const Unlocked&) { return std::visit(use, worlds_); });
  }

  /// `use(world)` for a query, beside others and without the interpreter's lock.
  template <class Use>
  auto read(Use use) {
    const Usage::Read read(usage_);
    return without_lock([&](const Unlocked&) { return std::visit(use, std::as_const(worlds_)); });
  }

  /// `use(world, i)` for each of `count` queries, as `read`. Signals are handled between two of them.
  template <class Use>
  void query_each(std::size_t count, Use use) {
    const Usage::Read read(usage_);
    without_lock([&](const Unlocked& unlocked) {
      std::visit(
          [&](const auto& world) {
            Signals signals(unlocked);
            for (std::size_t i = 0; i < count; ++i) {
              signals.check();
              use(world, i);
            }
          },
          worlds_);
    });
  }

  std::shared_ptr<ThreadPool> executor_;
  std::variant<World, World64> worlds_;
  Usage usage_{"World"};
};

void add_world(py::module_& module);

}  // namespace boxstream::python
