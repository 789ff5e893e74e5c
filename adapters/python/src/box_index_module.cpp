// SPDX-License-Identifier: MIT
// BoxIndex as Python sees it.
#include "box_index.hpp"

namespace boxstream::python {

namespace {

constexpr const char* about = R"(BoxIndex(boxes, *, dimensions=3, copy=None, invalid='warn')

Boxes that stay: an index made once, asked often, saved as bytes, pickled. It answers as a World of these boxes would, by
their indices. For all pairs of boxes find_pairs takes less time than making this.

boxes: as in boxstream.find_pairs. The index keeps copies, of float32 if they are that and else of float64, if that
    changes no number.
dimensions, copy, invalid: as in boxstream.find_pairs.

Any number of threads may ask at once.)";

}  // namespace

void add_box_index(py::module_& module) {
  using py::arg;
  const py::none none;
  py::class_<PyBoxIndex>(module, "BoxIndex", about)
      .def(py::init<py::handle, py::handle, py::handle, py::handle>(), arg("boxes"), py::kw_only(),
           arg("dimensions") = 3, arg("copy") = none, arg("invalid") = "warn")
      .def("__len__", &PyBoxIndex::size)
      .def_property_readonly(
          "dtype", [](const PyBoxIndex& self) { return dtype_of(self.scalar()); }, "numpy.dtype of boxes.")
      .def_property_readonly("dimensions", &PyBoxIndex::dimensions, "int: 3, 2 or 1.")
      .def_property_readonly("bounds", &PyBoxIndex::bounds,
                             "array of the index's dtype, shape (2 * dimensions,): a box around all valid boxes; "
                             "min > max if there are none.")
      .def("query_boxes", &PyBoxIndex::query_boxes, arg("boxes"), py::kw_only(), arg("dtype") = "int64",
           R"(query_boxes(boxes, *, dtype='int64')

Boxes of the index that overlap or touch each of boxes.

boxes: array of the index's dtype, shape (n, 6) or (n, 2, 3), or of its dimensions.
dtype: 'int64', 'int32' or 'uint32', of the result.

Returns an array of shape (k, 2): indices of boxes, and of boxes of the index, in no particular order.)")
      .def("query_rays", &PyBoxIndex::query_rays, arg("origins"), arg("directions"), arg("lengths") = none,
           R"(query_rays(origins, directions, lengths=None)

Boxes that each ray meets. Parameters: as World.query_rays, of as many coordinates as the index has dimensions.

Returns three arrays of shape (k,): int64, which ray, ascending; int64, indices of boxes, for one ray in no particular
order; the index's dtype, t where the ray enters, 0 if it starts inside.)")
      .def("cast_rays", &PyBoxIndex::cast_rays, arg("origins"), arg("directions"), arg("lengths") = none,
           R"(cast_rays(origins, directions, lengths=None)

The first box that each ray meets, of several the one with the smallest index. Parameters: as query_rays.

Returns two arrays of shape (n,): int64, indices, -1 where the ray meets nothing; the index's dtype, t where the ray
enters, infinite where it meets nothing.)")
      .def("query_nearest", &PyBoxIndex::query_nearest, arg("points"), arg("count") = 1,
           R"(query_nearest(points, count=1)

The boxes nearest to each point, nearest first, ties by index. Distances are compared without rounding.

points: array of the index's dtype, shape (n, dimensions). count: int.

Returns an array of int64, shape (n, count): indices, -1 where there are no more.)")
      .def("save", &PyBoxIndex::save, R"(save()

The index as bytes, read on all machines: 28 a box of float32, 52 of float64. BoxIndex.load makes it of them in a
fraction of the time of building, as do C++'s BoxIndex::load and pickle.)")
      .def_static(
          "load",
          [](py::handle saved, py::handle dimensions) { return PyBoxIndex(bytes_of(saved, "saved"), dimensions); },
          arg("saved"), py::kw_only(), arg("dimensions") = 3, R"(load(saved, *, dimensions=3)

The index whose save() gave these bytes. ValueError for others.

dimensions: as it was made; the bytes do not say it.)")
      .def(py::pickle([](const PyBoxIndex& self) { return py::make_tuple(self.save(), self.dimensions()); },
                      [](const py::tuple& state) { return PyBoxIndex(state[0].cast<py::bytes>(), state[1]); }));
}

}  // namespace boxstream::python
