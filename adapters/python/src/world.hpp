// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apart.hpp"
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

  /// As bytes; std::runtime_error if something has changed since the last update.
  py::bytes save();
  static std::unique_ptr<PyWorld> load(const py::bytes& saved, py::handle executor);

  Scalar scalar() const { return worlds_.index() == 0 ? Scalar::float32 : Scalar::float64; }

  py::array create(py::handle boxes, py::handle groups, py::handle masks, py::handle users, py::handle invalid);
  std::size_t move(py::handle ids, py::handle boxes, py::handle invalid);
  std::size_t destroy(py::handle ids);
  std::size_t set_filters(py::handle ids, py::handle groups, py::handle masks);
  void clear();
  void shrink_to_fit();
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

  /// `use(world)` as `change`, of so many boxes that it may take long: run apart, and may run on after this has thrown.
  template <class Use>
  void change_apart(Use use) {
    struct Held {
      Held(py::object object, Usage& usage) : self(std::move(object)), change(usage) {}
      py::object self;
      Usage::Change change;
    };
    const auto held = std::make_shared<Held>(py::cast(this, py::return_value_policy::reference), usage_);
    run_apart([this, held, use] { std::visit(use, worlds_); });
  }

  /// `use(world)` for a query, beside others and without the interpreter's lock.
  template <class Use>
  auto read(Use use) {
    const Usage::Read read(usage_);
    return without_lock([&](const Unlocked&) { return std::visit(use, std::as_const(worlds_)); });
  }

  /// `use(world, signals)` as `read`, which checks them now and then.
  template <class Use>
  auto read_long(Use use) {
    const Usage::Read read(usage_);
    return without_lock([&](const Unlocked& unlocked) {
      Signals signals(unlocked);
      return std::visit([&](const auto& world) { return use(world, signals); }, worlds_);
    });
  }

  /// `use(world, i)` for each of `count` queries, as `read_long`.
  template <class Use>
  void query_each(std::size_t count, Use use) {
    read_long([&](const auto& world, Signals& signals) {
      for (std::size_t i = 0; i < count; ++i) {
        signals.check();
        use(world, i);
      }
    });
  }

  /// What `save` cannot ask the World.
  struct Journal {
    std::vector<ProxyId> created;            // in this order; some are stale
    std::vector<std::uint32_t> generations;  // of each slot, the last that was given out

    /// So that `note` of so many cannot throw.
    void reserve(std::size_t more);
    void note(Span<const ProxyId> ids) noexcept;
    /// Where they are many.
    void forget_stale(const auto& world) {
      if (created.size() < 2 * world.size() + 1024) return;
      created.erase(std::remove_if(created.begin(), created.end(), [&](ProxyId id) { return !world.contains(id); }),
                    created.end());
    }
  };
  /// The events of the last update of the World that this one was loaded from.
  struct LastEvents {
    std::vector<ProxyPair> begun, ended;
  };

  static std::vector<ProxyPair> pairs_in(const auto& world, Signals& signals) {
    std::vector<ProxyPair> pairs;
    pairs.reserve(world.pair_count());
    world.stream_pairs([&](Span<const ProxyPair> batch) {
      signals.check();
      pairs.insert(pairs.end(), batch.begin(), batch.end());
      return true;
    });
    return pairs;
  }
  std::vector<ProxyPair> begun_in(const auto& world) const {
    return last_ ? last_->begun : std::vector<ProxyPair>(world.begun().begin(), world.begun().end());
  }
  std::vector<ProxyPair> ended_in(const auto& world) const {
    return last_ ? last_->ended : std::vector<ProxyPair>(world.ended().begin(), world.ended().end());
  }

  std::shared_ptr<ThreadPool> executor_;
  WorldOptions options_;
  std::variant<World, World64> worlds_;
  Journal journal_;
  std::optional<LastEvents> last_;
  std::size_t changes_ = 0;  // of proxies, since the last update
  Usage usage_{"World"};
};

void add_world(py::module_& module);

}  // namespace boxstream::python
