// SPDX-License-Identifier: MIT
// A loop over queries, with results of all of them in flat arrays.
#include <limits>
#include <optional>
#include <vector>

#include "world.hpp"

namespace boxstream::python {

namespace {

/// What several queries found: the index of the query and the id, for each hit.
struct Hits {
  std::vector<std::int64_t> queries;
  std::vector<ProxyId> ids;

  void add(std::size_t query, ProxyId id) {
    queries.push_back(static_cast<std::int64_t>(query));
    ids.push_back(id);
  }
};

Wanted of_world(Element element, Scalar scalar) {
  Wanted wanted{{std::move(element)}};
  wanted.owner = "the World has";
  wanted.scalar = scalar;
  return wanted;
}

/// Rays as the caller gave them.
class Rays {
 public:
  Rays(py::handle origins, py::handle directions, py::handle lengths, Scalar scalar)
      : origins_(origins, "origins", of_world({3}, scalar)),
        directions_(directions, "directions", of_world({3}, scalar)) {
    require_as_many(directions_.size(), "directions");
    if (lengths.is_none()) return;
    if (is_one_number(lengths)) {
      length_ = with_float(scalar, [&](auto s) -> double { return number_of<decltype(s)>(lengths, "lengths"); });
      return;
    }
    lengths_.emplace(lengths, "lengths", of_world({}, scalar));
    require_as_many(lengths_->size(), "lengths");
  }

  std::size_t size() const { return origins_.size(); }

  template <class S>
  BasicRay<S> ray(std::size_t i) const {
    const boxstream::detail::DefaultFloatEnvironment environment;  // it is made here, not in the library
    const S* const o = origins_.data<S>() + 3 * i;
    const S* const d = directions_.data<S>() + 3 * i;
    return BasicRay<S>::along({o[0], o[1], o[2]}, {d[0], d[1], d[2]},
                              lengths_ ? lengths_->data<S>()[i] : static_cast<S>(length_));
  }

 private:
  void require_as_many(std::size_t given, const char* name) const {
    if (given != size())
      throw py::value_error(std::string(name) + ": expected one for each of " + std::to_string(size()) +
                            " origins, got " + std::to_string(given));
  }

  Numbers origins_, directions_;
  std::optional<Numbers> lengths_;
  double length_ = std::numeric_limits<double>::infinity();
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
  const Rays rays(origins, directions, lengths, scalar());
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
  const Rays rays(origins, directions, lengths, scalar());
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
  const Numbers given(points, "points", of_world({3}, scalar()));
  const std::size_t size = given.size(), count = count_of(count_each, "count", 0);
  if (count > std::vector<ProxyId>().max_size() / std::max<std::size_t>(size, 1))
    throw py::value_error("count: too many for " + std::to_string(size) + " points, got " + std::to_string(count));
  std::vector<ProxyId> nearest(size * count);
  query_each(size, [&]<class S>(const BasicWorld<S>& world, std::size_t i) {
    const S* const point = given.data<S>() + 3 * i;
    world.query_nearest({point[0], point[1], point[2]}, Span<ProxyId>(nearest).subspan(i * count, count));
  });
  return array_of<std::uint64_t>(std::move(nearest), {static_cast<py::ssize_t>(size), static_cast<py::ssize_t>(count)});
}

}  // namespace boxstream::python
