// SPDX-License-Identifier: MIT
// A loop over queries, with results of all of them in flat arrays.
#include <limits>
#include <vector>

#include "rays.hpp"
#include "world.hpp"

namespace boxstream::python {

namespace {

constexpr const char* owner = "the World has";

/// What several queries found: the index of the query and the id, for each hit.
struct Hits {
  std::vector<std::int64_t> queries;
  std::vector<ProxyId> ids;

  void add(std::size_t query, ProxyId id) {
    queries.push_back(static_cast<std::int64_t>(query));
    ids.push_back(id);
  }
};

}  // namespace

py::tuple PyWorld::query_boxes(py::handle boxes) {
  const Boxes given(boxes, "boxes", Invalid::skip, scalar(), "the World has");
  Hits hits;
  query_each(given.size(), [&]<class S>(const BasicWorld<S>& world, std::size_t i) {
    world.query_box(given.as<S>()[i], [&](ProxyId id) {
      hits.add(i, id);
      return true;
    });
  });
  return py::make_tuple(array_of<std::int64_t>(std::move(hits.queries)), array_of<std::uint64_t>(std::move(hits.ids)));
}

py::tuple PyWorld::query_rays(py::handle origins, py::handle directions, py::handle lengths) {
  const Rays rays(origins, directions, lengths, {scalar(), owner});
  return with_float(scalar(), [&](auto s) {
    using S = decltype(s);
    Hits hits;
    std::vector<S> enters;
    query_each(rays.size(), [&]<class T>(const BasicWorld<T>& world, std::size_t i) {
      world.query_ray(rays.ray<T>(i), [&](ProxyId id, T enter, T length) {
        hits.add(i, id);
        enters.push_back(static_cast<S>(enter));
        return length;
      });
    });
    return py::make_tuple(array_of<std::int64_t>(std::move(hits.queries)), array_of<std::uint64_t>(std::move(hits.ids)),
                          array_of<S>(std::move(enters)));
  });
}

py::tuple PyWorld::cast_rays(py::handle origins, py::handle directions, py::handle lengths) {
  const Rays rays(origins, directions, lengths, {scalar(), owner});
  return with_float(scalar(), [&](auto s) {
    using S = decltype(s);
    std::vector<ProxyId> first(rays.size());
    std::vector<S> enters(rays.size(), std::numeric_limits<S>::infinity());
    query_each(rays.size(), [&]<class T>(const BasicWorld<T>& world, std::size_t i) {
      world.query_ray(rays.ray<T>(i), [&](ProxyId id, T enter, T) {
        const S at = static_cast<S>(enter);
        if (!first[i] || at < enters[i] || (at == enters[i] && id.slot < first[i].slot)) {
          first[i] = id;
          enters[i] = at;
        }
        return enter;
      });
    });
    return py::make_tuple(array_of<std::uint64_t>(std::move(first)), array_of<S>(std::move(enters)));
  });
}

py::array PyWorld::query_nearest(py::handle points, py::handle count_each) {
  const Points given(points, "points", {scalar(), owner});
  const std::size_t size = given.size(), count = count_of(count_each, "count", 0);
  require_room(size, count);
  std::vector<ProxyId> nearest(size * count);
  query_each(size, [&]<class S>(const BasicWorld<S>& world, std::size_t i) {
    const auto point = given.point<S>(i);
    world.query_nearest({point[0], point[1], point[2]}, Span<ProxyId>(nearest).subspan(i * count, count));
  });
  return array_of<std::uint64_t>(std::move(nearest), {static_cast<py::ssize_t>(size), static_cast<py::ssize_t>(count)});
}

}  // namespace boxstream::python
