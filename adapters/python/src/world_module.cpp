// SPDX-License-Identifier: MIT
// World as Python sees it.
#include "world.hpp"

namespace boxstream::python {

namespace {

constexpr const char* about =
    R"(World(dtype='float32', executor=None, sticky_filters=False, *, method='planned', cutoff=0)

Boxes that live from frame to frame. An update finds which pairs began and ended; queries see the present boxes.

dtype: 'float32' or 'float64': of all boxes, points and rays that it takes and gives.
executor: Executor for updates, or None for the calling thread.
sticky_filters: False: a pair ends at the next update if changed groups and masks refuse it. True: they are tested only
    when a pair begins.
method, cutoff: as of Detector. With 'hybrid' each update in which a box has changed is one search of all.

A box in a World is a proxy. Its id is a number of uint64; 0 is no proxy, and the id of a destroyed proxy stays stale.
Boxes, points and rays in C order and of its dtype are read where they lie; others are copied, if that changes no number.
Results are copies, and the caller's.
Queries may run in several Python threads at once. What changes a World needs it alone; RuntimeError otherwise.)";

using WorldClass = py::class_<PyWorld>;

void add_changes(WorldClass& world) {
  using py::arg;
  const py::none none;
  world
      .def("create", &PyWorld::create, arg("boxes"), arg("groups") = none, arg("masks") = none, arg("users") = none,
           py::kw_only(), arg("invalid") = "warn",
           R"(create(boxes, groups=None, masks=None, users=None, *, invalid='warn')

New proxies, whose pairs begin at the next update.

boxes: array of the World's dtype, shape (n, 6) or (n, 2, 3).
groups, masks: integers, shape (n,), or None: see boxstream.find_pairs.
users: integers, shape (n,), or None for zeros: numbers of the caller's.
invalid: 'warn': boxes with a NaN or min > max have no pairs until they move, and more than a tenth of them are an
    InvalidBoxesWarning. 'skip': without it. 'raise': they are a ValueError.

Returns their ids, an array of uint64, shape (n,).)")
      .def("move", &PyWorld::move, arg("ids"), arg("boxes"), py::kw_only(), arg("invalid") = "skip",
           R"(move(ids, boxes, *, invalid='skip')

Replaces boxes. Fastest if ids are in order of creation.

ids: array of uint64, shape (n,). boxes: array of the World's dtype, shape (n, 6) or (n, 2, 3). invalid: as create.

Returns an int: how many ids were live.)")
      .def("destroy", &PyWorld::destroy, arg("ids"), R"(destroy(ids)

Removes proxies. Their pairs end at the next update, with ids that are stale by then.

ids: array of uint64, shape (n,).

Returns an int: how many ids were live.)")
      .def("set_filters", &PyWorld::set_filters, arg("ids"), arg("groups") = none, arg("masks") = none,
           R"(set_filters(ids, groups=None, masks=None)

Replaces groups and masks; None sets the defaults, 1 and 0xffffffff.

ids: array of uint64, shape (n,). groups, masks: integers, shape (n,), or None.

Returns an int: how many ids were live.)")
      .def("clear", &PyWorld::clear, "clear()\n\nBack to the state of a new World: ids start again.")
      .def("shrink_to_fit", &PyWorld::shrink_to_fit,
           "shrink_to_fit()\n\nGives back what memory its boxes and pairs do not need.")
      .def("update", &PyWorld::update, R"(update()

Brings pairs up to date with boxes and filters. Returns WorldStats.)");
}

void add_stored(WorldClass& world) {
  using py::arg;
  const py::none none;
  world
      .def("save", &PyWorld::save, R"(save()

The World as bytes, the same on all machines: boxes, ids, groups and masks, users, pairs, begun and ended. RuntimeError
if something has changed since the last update().

A World can be pickled, too; an Executor is not.)")
      .def_static(
          "load",
          [](py::handle saved, py::handle executor) { return PyWorld::load(bytes_of(saved, "saved"), executor); },
          arg("saved"), arg("executor") = none, R"(load(saved, executor=None)

The World whose save() gave these bytes: with the same ids, of which stale ones stay stale, and the same pairs. Ids of
proxies created later may be others than there. ValueError for other bytes.)")
      .def(py::pickle([](PyWorld& self) { return self.save(); },
                      [](const py::bytes& saved) { return PyWorld::load(saved, py::none()); }));
}

void add_contents(WorldClass& world) {
  using py::arg;
  world.def("__len__", &PyWorld::size)
      .def_property_readonly(
          "dtype", [](const PyWorld& self) { return dtype_of(self.scalar()); }, "numpy.dtype of boxes.")
      .def("contains", &PyWorld::contains, arg("ids"), R"(contains(ids)

ids: array of uint64, shape (n,).

Returns an array of bool, shape (n,): False for stale ids and 0.)")
      .def("boxes", &PyWorld::boxes, arg("ids"), R"(boxes(ids)

ids: array of uint64, shape (n,), all live; ValueError otherwise.

Returns an array of the World's dtype, shape (n, 6).)")
      .def("users", &PyWorld::users, arg("ids"), R"(users(ids)

ids: array of uint64 of any shape, all live; ValueError otherwise. world.users(world.begun) has the caller's numbers.

Returns an array of int64 of the same shape.)")
      .def_property_readonly("bounds", &PyWorld::bounds,
                             "array of the World's dtype, shape (6,): a box around all valid boxes; min > max if there "
                             "are none.")
      .def_property_readonly("begun", &PyWorld::begun,
                             "array of uint64, shape (k, 2): ids of the pairs that began in the last update.")
      .def_property_readonly("ended", &PyWorld::ended,
                             "array of uint64, shape (k, 2): ids of the pairs that ended in the last update.")
      .def_property_readonly("pairs", &PyWorld::pairs,
                             "array of uint64, shape (k, 2): ids of all pairs, sorted by creation of the first, then "
                             "of the second. The first was created before the second.");
}

void add_queries(WorldClass& world) {
  using py::arg;
  const py::none none;
  world
      .def("query_boxes", &PyWorld::query_boxes, arg("boxes"), R"(query_boxes(boxes)

Proxies that overlap or touch each box.

boxes: array of the World's dtype, shape (n, 6) or (n, 2, 3).

Returns two arrays of shape (k,): int64, which of boxes, ascending; uint64, ids, for one box in no particular order.)")
      .def("query_rays", &PyWorld::query_rays, arg("origins"), arg("directions"), arg("lengths") = none,
           R"(query_rays(origins, directions, lengths=None)

Proxies that each ray meets: the points origin + t * direction, 0 <= t <= length.

origins, directions: arrays of the World's dtype, shape (n, 3). Directions need no unit length.
lengths: float, rounded up to the World's dtype, or array of that, shape (n,), in multiples of the directions; None: no
    end.

Returns three arrays of shape (k,): int64, which ray, ascending; uint64, ids, for one ray in no particular order; the
World's dtype, t where the ray enters, 0 if it starts inside.)")
      .def("cast_rays", &PyWorld::cast_rays, arg("origins"), arg("directions"), arg("lengths") = none,
           R"(cast_rays(origins, directions, lengths=None)

The first proxy that each ray meets. Parameters: as query_rays.

Returns two arrays of shape (n,): uint64, ids, 0 where the ray meets nothing; the World's dtype, t where the ray enters,
infinite where it meets nothing.)")
      .def("query_nearest", &PyWorld::query_nearest, arg("points"), arg("count") = 1,
           R"(query_nearest(points, count=1)

The proxies nearest to each point, nearest first, ties in order of creation. Distances are compared without rounding.

points: array of the World's dtype, shape (n, 3). count: int.

Returns an array of uint64, shape (n, count): ids, 0 where there are no more.)");
}

}  // namespace

void add_world(py::module_& module) {
  WorldClass world(module, "World", about);
  world.def(py::init([](py::handle dtype, py::handle executor, py::handle sticky_filters, py::handle method,
                        py::handle cutoff) {
              return std::make_unique<PyWorld>(dtype, executor,
                                               WorldOptions{nullptr, flag_of(sticky_filters, "sticky_filters"),
                                                            method_of(method), cutoff_of(cutoff)});
            }),
            py::arg("dtype") = "float32", py::arg("executor") = py::none(), py::arg("sticky_filters") = false,
            py::kw_only(), py::arg("method") = "planned", py::arg("cutoff") = 0);
  add_stored(world);
  add_changes(world);
  add_contents(world);
  add_queries(world);
}

}  // namespace boxstream::python
