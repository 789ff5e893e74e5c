// SPDX-License-Identifier: MIT
#include "box_index.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "apart.hpp"
#include "rays.hpp"
#include "search.hpp"

namespace boxstream::python {

namespace {

constexpr const char* owner = "the index has";

/// Boxes that are asked at a time: between two of such portions signals are handled.
constexpr std::size_t portion = 4096;

/// What a stored box of float32 takes.
constexpr std::size_t bytes_of_a_box = 28;

/// Boxes as they are given, of float64 where they are integers.
std::shared_ptr<const Boxes> boxes_of(py::handle given, const BoxFormat& format) {
  auto boxes = std::make_shared<const Boxes>(given, "boxes", format);
  if (boxes->scalar() == Scalar::float32 || boxes->scalar() == Scalar::float64) return boxes;
  return std::make_shared<const Boxes>(boxes->array(), "boxes", format.invalid, Scalar::float64, owner,
                                       format.dimensions, format.may_copy);
}

/// `work()` of so many boxes, without the interpreter's lock. Where they are many it is run apart: it owns all that it
/// uses.
void run_unlocked(std::size_t boxes, const std::function<void()>& work) {
  if (boxes < least_apart)
    without_lock([&](const Unlocked&) { work(); });
  else
    run_apart(work);
}

std::variant<BoxIndex, BoxIndex64> built(const std::shared_ptr<const Boxes>& boxes) {
  const auto index = std::make_shared<std::variant<BoxIndex, BoxIndex64>>();
  run_unlocked(boxes->size(), [boxes, index] {
    with_float(boxes->scalar(), [&](auto s) { *index = BasicBoxIndex<decltype(s)>(boxes->as<decltype(s)>()); });
  });
  return std::move(*index);
}

/// The coordinates of these bytes are of 4 bytes or of 8; what else may be wrong with them `load` says.
std::variant<BoxIndex, BoxIndex64> loaded(const py::bytes& saved) {
  char* data = nullptr;
  py::ssize_t size = 0;
  if (PyBytes_AsStringAndSize(saved.ptr(), &data, &size) != 0) throw py::error_already_set();
  const Span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(data), static_cast<std::size_t>(size));
  const bool is_double = size > 12 && data[12] == 8;
  const auto index = std::make_shared<std::variant<BoxIndex, BoxIndex64>>();
  run_unlocked(bytes.size() / bytes_of_a_box, [saved, bytes, is_double, index] {
    try {
      if (is_double)
        *index = BoxIndex64::load(bytes);
      else
        *index = BoxIndex::load(bytes);
    } catch (const std::runtime_error& error) {
      throw py::value_error(error.what());
    }
  });
  return std::move(*index);
}

constexpr std::int64_t nothing = -1;

}  // namespace

PyBoxIndex::PyBoxIndex(py::handle boxes, py::handle dimensions, py::handle copy, py::handle invalid)
    : dimensions_(dimensions_of(dimensions)) {
  const BoxFormat format{dimensions_, may_copy(copy), invalid_policy(invalid)};
  const auto given = boxes_of(boxes, format);
  indices_ = built(given);
  if (format.invalid == Invalid::warn) warn_of_boxes(*given, nullptr, invalid_of(*given), given->size());
}

PyBoxIndex::PyBoxIndex(const py::bytes& saved, py::handle dimensions)
    : dimensions_(dimensions_of(dimensions)), indices_(loaded(saved)) {}

py::bytes PyBoxIndex::save() const {
  const auto bytes = std::make_shared<std::vector<std::uint8_t>>();
  run_unlocked(size(), [this, self = py::cast(this, py::return_value_policy::reference), bytes] {
    *bytes = std::visit([](const auto& index) { return index.save(); }, indices_);
  });
  return py::bytes(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

std::size_t PyBoxIndex::size() const {
  return std::visit([](const auto& index) { return index.size(); }, indices_);
}

py::array PyBoxIndex::bounds() const {
  return std::visit(
      [&]<class S>(const BasicBoxIndex<S>& index) -> py::array {
        const BasicAabb<S> box = index.bounds();
        std::vector<S> ends(&box.min[0], &box.min[0] + dimensions_);
        ends.insert(ends.end(), &box.max[0], &box.max[0] + dimensions_);
        return array_of<S>(std::move(ends));
      },
      indices_);
}

py::array PyBoxIndex::query_boxes(py::handle boxes, py::handle dtype) const {
  const Indices type = indices_of(dtype);
  const Boxes given(boxes, "boxes", Invalid::skip, scalar(), owner, dimensions_);
  std::vector<Pair> pairs;
  without_lock([&](const Unlocked& unlocked) {
    Signals signals(unlocked);
    std::visit(
        [&]<class S>(const BasicBoxIndex<S>& index) {
          const Span<const BasicAabb<S>> all = given.as<S>();
          std::vector<Pair> found;
          for (std::size_t first = 0; first < all.size(); first += portion) {
            signals.check();
            index.query_boxes(all.subspan(first, std::min(portion, all.size() - first)), found);
            for (const Pair pair : found) pairs.push_back({static_cast<std::uint32_t>(first) + pair.a, pair.b});
          }
        },
        indices_);
  });
  return index_array(std::move(pairs), type, 2);
}

namespace {

/// `use(index, i)` for each of `count` queries, without the interpreter's lock. Signals are handled between two of
/// them.
template <class Indices, class Use>
void query_each(const Indices& indices, std::size_t count, Use use) {
  without_lock([&](const Unlocked& unlocked) {
    std::visit(
        [&](const auto& index) {
          Signals signals(unlocked);
          for (std::size_t i = 0; i < count; ++i) {
            signals.check();
            use(index, i);
          }
        },
        indices);
  });
}

}  // namespace

py::tuple PyBoxIndex::query_rays(py::handle origins, py::handle directions, py::handle lengths) const {
  const Rays rays(origins, directions, lengths, {scalar(), owner, dimensions_});
  return with_float(scalar(), [&](auto s) {
    using S = decltype(s);
    std::vector<std::int64_t> which, found;
    std::vector<S> enters;
    query_each(indices_, rays.size(), [&]<class T>(const BasicBoxIndex<T>& index, std::size_t i) {
      index.query_ray(rays.ray<T>(i), [&](std::uint32_t box, T enter, T length) {
        which.push_back(static_cast<std::int64_t>(i));
        found.push_back(box);
        enters.push_back(static_cast<S>(enter));
        return length;
      });
    });
    return py::make_tuple(array_of<std::int64_t>(std::move(which)), array_of<std::int64_t>(std::move(found)),
                          array_of<S>(std::move(enters)));
  });
}

py::tuple PyBoxIndex::cast_rays(py::handle origins, py::handle directions, py::handle lengths) const {
  const Rays rays(origins, directions, lengths, {scalar(), owner, dimensions_});
  return with_float(scalar(), [&](auto s) {
    using S = decltype(s);
    std::vector<std::int64_t> first(rays.size(), nothing);
    std::vector<S> enters(rays.size(), std::numeric_limits<S>::infinity());
    query_each(indices_, rays.size(), [&]<class T>(const BasicBoxIndex<T>& index, std::size_t i) {
      index.query_ray(rays.ray<T>(i), [&](std::uint32_t box, T enter, T) {
        const S at = static_cast<S>(enter);
        if (first[i] == nothing || at < enters[i] || (at == enters[i] && box < first[i])) {
          first[i] = box;
          enters[i] = at;
        }
        return enter;
      });
    });
    return py::make_tuple(array_of<std::int64_t>(std::move(first)), array_of<S>(std::move(enters)));
  });
}

py::array PyBoxIndex::query_nearest(py::handle points, py::handle count_each) const {
  const Points given(points, "points", {scalar(), owner, dimensions_});
  const std::size_t size = given.size(), count = count_of(count_each, "count", 0);
  require_room(size, count);
  std::vector<std::int64_t> nearest(size * count, nothing);
  std::vector<std::uint32_t> found(std::min(count, this->size()));
  query_each(indices_, size, [&]<class S>(const BasicBoxIndex<S>& index, std::size_t i) {
    const auto point = given.point<S>(i);
    const std::size_t filled = index.query_nearest({point[0], point[1], point[2]}, found);
    std::copy_n(found.begin(), filled, nearest.begin() + static_cast<std::ptrdiff_t>(i * count));
  });
  return array_of<std::int64_t>(std::move(nearest), {static_cast<py::ssize_t>(size), static_cast<py::ssize_t>(count)});
}

}  // namespace boxstream::python
