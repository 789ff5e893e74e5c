// SPDX-License-Identifier: MIT
#include "world.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <pybind11/stl.h>

#include "search.hpp"

namespace boxstream::python {

static_assert(sizeof(ProxyPair) == 2 * sizeof(std::uint64_t));

namespace {

Scalar scalar_from(py::handle given) {
  const py::dtype dtype = py::dtype::from_args(py::reinterpret_borrow<py::object>(given));
  for (const Scalar scalar : {Scalar::float32, Scalar::float64})
    if (dtype.equal(dtype_of(scalar))) return scalar;
  throw py::type_error("dtype: expected float32 or float64, got " + text_of(dtype));
}

std::variant<World, World64> make_world(Scalar scalar, const WorldOptions& options) {
  if (scalar == Scalar::float32) return World(options);
  return World64(options);
}

WorldOptions with_executor(WorldOptions options, Executor* executor) {
  options.executor = executor;
  return options;
}

py::array pair_array(std::vector<ProxyPair>&& pairs) {
  return array_of<std::uint64_t>(std::move(pairs));
}

/// ValueError if one of the ids is stale or null.
template <class S>
void require_live(const BasicWorld<S>& world, Span<const ProxyId> ids) {
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (!world.contains(ids[i]))
      throw std::invalid_argument("ids: expected ids of live proxies, got a stale or null one at ids[" +
                                  std::to_string(i) + "]");
}

/// Before anything changes: Python may turn the warning into an exception.
void warn_as_asked(Invalid policy, const Boxes& boxes) {
  if (policy == Invalid::warn) warn_of_boxes(boxes, nullptr, invalid_of(boxes), boxes.size());
}

}  // namespace

PyWorld::PyWorld(py::handle dtype, py::handle executor, WorldOptions options)
    : executor_(executor_of(executor)),
      options_(options),
      worlds_(make_world(scalar_from(dtype), with_executor(options, executor_.get()))) {}

py::array PyWorld::create(py::handle boxes, py::handle groups, py::handle masks, py::handle users, py::handle invalid) {
  const Invalid policy = invalid_policy(invalid);
  const Boxes given(boxes, "boxes", policy, scalar(), "the World has");
  const std::vector<Filter> filters = filters_of(groups, masks, given.size(), "");
  std::vector<std::int64_t> numbers;
  if (!users.is_none()) numbers = integers_of<std::int64_t>(users, "users", given.size());
  const Span<const std::uint64_t> bits(reinterpret_cast<const std::uint64_t*>(numbers.data()), numbers.size());
  std::vector<ProxyId> ids(given.size());
  warn_as_asked(policy, given);
  change([&]<class S>(BasicWorld<S>& world) {
    changes_ += ids.size();
    journal_.reserve(ids.size());
    world.create(given.as<S>(), filters, ids, bits);
    journal_.note(ids);
  });
  return array_of<std::uint64_t>(std::move(ids));
}

std::size_t PyWorld::move(py::handle ids, py::handle boxes, py::handle invalid) {
  const std::vector<ProxyId> moved = ids_of(ids, "ids");
  const Invalid policy = invalid_policy(invalid);
  const Boxes given(boxes, "boxes", policy, scalar(), "the World has");
  if (given.size() != moved.size())
    throw py::value_error("boxes: expected one for each of " + std::to_string(moved.size()) + " ids, got " +
                          std::to_string(given.size()));
  warn_as_asked(policy, given);
  return change([&]<class S>(BasicWorld<S>& world) {
    changes_ += moved.size();
    return world.move(moved, given.as<S>());
  });
}

std::size_t PyWorld::destroy(py::handle ids) {
  const std::vector<ProxyId> destroyed = ids_of(ids, "ids");
  return change([&](auto& world) {
    changes_ += destroyed.size();
    return world.destroy(destroyed);
  });
}

std::size_t PyWorld::set_filters(py::handle ids, py::handle groups, py::handle masks) {
  const std::vector<ProxyId> changed = ids_of(ids, "ids");
  std::vector<Filter> filters = filters_of(groups, masks, changed.size(), "");
  filters.resize(changed.size());
  return change([&](auto& world) {
    changes_ += changed.size();
    std::size_t live = 0;
    for (std::size_t i = 0; i < changed.size(); ++i) live += world.set_filter(changed[i], filters[i]) ? 1 : 0;
    return live;
  });
}

void PyWorld::clear() {
  change([this](auto& world) {
    world.clear();
    journal_ = {};
    last_.reset();
    changes_ = 0;
  });
}

void PyWorld::shrink_to_fit() {
  change([](auto& world) { world.shrink_to_fit(); });
}

WorldStats PyWorld::update() {
  const auto stats = std::make_shared<WorldStats>();
  const auto update = [this, stats](auto& world) {
    *stats = world.update();
    last_.reset();
    changes_ = 0;
    journal_.forget_stale(world);
  };
  // Each change may begin a pair with every box. Hardly any do, and to start a thread takes longer than to update
  // thousands of boxes.
  constexpr std::size_t few_pairs = 100'000'000;
  const std::size_t boxes = std::max<std::size_t>(1, size());
  if (changes_ <= few_pairs / boxes)
    change(update);
  else
    change_apart(update);
  return *stats;
}

std::size_t PyWorld::size() {
  return read([](const auto& world) { return world.size(); });
}

py::array PyWorld::contains(py::handle ids) {
  const std::vector<ProxyId> asked = ids_of(ids, "ids");
  py::array_t<bool> answers(static_cast<py::ssize_t>(asked.size()));
  bool* const out = answers.mutable_data();
  read([&](const auto& world) {
    for (std::size_t i = 0; i < asked.size(); ++i) out[i] = world.contains(asked[i]);
  });
  return answers;
}

py::array PyWorld::boxes(py::handle ids) {
  const std::vector<ProxyId> asked = ids_of(ids, "ids");
  return with_float(scalar(), [&](auto s) {
    using S = decltype(s);
    std::vector<BasicAabb<S>> found(asked.size());
    read([&]<class T>(const BasicWorld<T>& world) {
      require_live(world, asked);
      if constexpr (std::is_same_v<S, T>)
        for (std::size_t i = 0; i < asked.size(); ++i) found[i] = world.box(asked[i]);
    });
    return array_of<S>(std::move(found));
  });
}

py::array PyWorld::users(py::handle ids) {
  const bool is_array = py::isinstance<py::array>(ids);
  const py::object flat = is_array ? ids.attr("reshape")(-1) : py::reinterpret_borrow<py::object>(ids);
  const std::vector<ProxyId> asked = ids_of(flat, "ids");
  std::vector<std::uint64_t> found(asked.size());
  read([&](const auto& world) {
    require_live(world, asked);
    for (std::size_t i = 0; i < asked.size(); ++i) found[i] = world.user(asked[i]);
  });
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(asked.size())};
  if (is_array) shape = ids.attr("shape").cast<std::vector<py::ssize_t>>();
  return array_of<std::int64_t>(std::move(found), std::move(shape));
}

py::array PyWorld::bounds() {
  return with_float(scalar(), [&](auto s) {
    using S = decltype(s);
    std::vector<S> six(6);
    read([&](const auto& world) {
      const auto box = world.bounds();
      for (int d = 0; d < 3; ++d) {
        six[d] = static_cast<S>(box.min[d]);
        six[3 + d] = static_cast<S>(box.max[d]);
      }
    });
    return array_of<S>(std::move(six));
  });
}

py::array PyWorld::begun() {
  return pair_array(read([this](const auto& world) { return begun_in(world); }));
}

py::array PyWorld::ended() {
  return pair_array(read([this](const auto& world) { return ended_in(world); }));
}

py::array PyWorld::pairs() {
  return pair_array(read_long([](const auto& world, Signals& signals) { return pairs_in(world, signals); }));
}

}  // namespace boxstream::python
