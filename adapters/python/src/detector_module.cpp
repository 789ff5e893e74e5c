// SPDX-License-Identifier: MIT
// Detector as Python sees it. The functions of the package make one, use it once and drop it; they have the long texts.
#include "detector.hpp"

namespace boxstream::python {

namespace {

using py::arg;
using py::handle;

constexpr const char* about = R"(Detector(executor=None, *, method='planned', cutoff=0)

Searches that keep their scratch memory from one to the next. For use by one thread at a time; RuntimeError otherwise.

executor: Executor, or None for the calling thread.
method: how pairs are found; which ones they are does not depend on it. 'planned': the fastest for nearly all boxes.
    'hybrid': the streamed segment tree with scans of Zomorodian and Edelsbrunner, Fast software for box intersections,
    alone: several times slower, and worth comparing with.
cutoff: int, of 'hybrid': it scans nodes with fewer intervals or points than that. 0: samples tell when.)";

constexpr const char* about_find_pairs =
    R"(find_pairs(boxes, other=None, groups=None, masks=None, *, ids=None, ids_a=None, ids_b=None, closed=True, tolerance=0.0, dimensions=3, dtype='int64', max_pairs=None, copy=None, invalid='warn')

As boxstream.find_pairs.)";

constexpr const char* about_find_neighbours =
    R"(find_neighbours(boxes, other=None, groups=None, masks=None, *, both=True, ids=None, ids_a=None, ids_b=None, closed=True, tolerance=0.0, dimensions=3, dtype='int64', copy=None, invalid='warn')

As boxstream.find_neighbours.)";

constexpr const char* about_find_pairs_in_sets =
    R"(find_pairs_in_sets(boxes, offsets, other=None, other_offsets=None, groups=None, masks=None, *, ids=None, ids_a=None, ids_b=None, closed=True, tolerance=0.0, dimensions=3, dtype='int64', copy=None, invalid='warn')

As boxstream.find_pairs_in_sets.)";

constexpr const char* about_stream_pairs =
    R"(stream_pairs(boxes, callback, other=None, groups=None, masks=None, *, block=65536, ids=None, ids_a=None, ids_b=None, closed=True, tolerance=0.0, dimensions=3, dtype='int64', copy=None, invalid='warn')

As boxstream.stream_pairs.)";

constexpr const char* about_find_near_pairs =
    R"(find_near_pairs(points, distance, *, radii=None, dimensions=3, dtype='int64', max_pairs=None, invalid='warn')

As boxstream.find_near_pairs.)";

constexpr const char* about_stream_near_pairs =
    R"(stream_near_pairs(points, distance, callback, *, block=65536, radii=None, dimensions=3, dtype='int64', invalid='warn')

As boxstream.stream_near_pairs.)";

constexpr std::size_t usual_block = 65536;

void add_searches(py::class_<PyDetector>& detector) {
  const py::none none;
  detector.def(
      "find_pairs",
      [](PyDetector& self, handle boxes, handle other, handle groups, handle masks, handle ids, handle ids_a,
         handle ids_b, handle closed, handle tolerance, handle dimensions, handle dtype, handle max_pairs, handle copy,
         handle invalid) {
        return self.find_pairs(std::make_shared<Search>(SearchArguments{boxes, other, groups, masks, ids, ids_a, ids_b,
                                                                        closed, tolerance, dimensions, copy, invalid}),
                               dtype, max_pairs);
      },
      arg("boxes"), arg("other") = none, arg("groups") = none, arg("masks") = none, py::kw_only(), arg("ids") = none,
      arg("ids_a") = none, arg("ids_b") = none, arg("closed") = true, arg("tolerance") = 0.0, arg("dimensions") = 3,
      arg("dtype") = "int64", arg("max_pairs") = none, arg("copy") = none, arg("invalid") = "warn", about_find_pairs);
  detector.def(
      "find_neighbours",
      [](PyDetector& self, handle boxes, handle other, handle groups, handle masks, handle both, handle ids,
         handle ids_a, handle ids_b, handle closed, handle tolerance, handle dimensions, handle dtype, handle copy,
         handle invalid) {
        return self.find_neighbours(
            std::make_shared<Search>(SearchArguments{boxes, other, groups, masks, ids, ids_a, ids_b, closed, tolerance,
                                                     dimensions, copy, invalid}),
            both, dtype);
      },
      arg("boxes"), arg("other") = none, arg("groups") = none, arg("masks") = none, py::kw_only(), arg("both") = true,
      arg("ids") = none, arg("ids_a") = none, arg("ids_b") = none, arg("closed") = true, arg("tolerance") = 0.0,
      arg("dimensions") = 3, arg("dtype") = "int64", arg("copy") = none, arg("invalid") = "warn",
      about_find_neighbours);
  detector.def(
      "find_pairs_in_sets",
      [](PyDetector& self, handle boxes, handle offsets, handle other, handle other_offsets, handle groups,
         handle masks, handle ids, handle ids_a, handle ids_b, handle closed, handle tolerance, handle dimensions,
         handle dtype, handle copy, handle invalid) {
        return self.find_pairs_in_sets(
            std::make_shared<Search>(SearchArguments{boxes, other, groups, masks, ids, ids_a, ids_b, closed, tolerance,
                                                     dimensions, copy, invalid}),
            offsets, other_offsets, dtype);
      },
      arg("boxes"), arg("offsets"), arg("other") = none, arg("other_offsets") = none, arg("groups") = none,
      arg("masks") = none, py::kw_only(), arg("ids") = none, arg("ids_a") = none, arg("ids_b") = none,
      arg("closed") = true, arg("tolerance") = 0.0, arg("dimensions") = 3, arg("dtype") = "int64", arg("copy") = none,
      arg("invalid") = "warn", about_find_pairs_in_sets);
  detector.def(
      "stream_pairs",
      [](PyDetector& self, handle boxes, handle callback, handle other, handle groups, handle masks, handle block,
         handle ids, handle ids_a, handle ids_b, handle closed, handle tolerance, handle dimensions, handle dtype,
         handle copy, handle invalid) {
        return self.stream_pairs(
            Search({boxes, other, groups, masks, ids, ids_a, ids_b, closed, tolerance, dimensions, copy, invalid}),
            callback, block, dtype);
      },
      arg("boxes"), arg("callback"), arg("other") = none, arg("groups") = none, arg("masks") = none, py::kw_only(),
      arg("block") = usual_block, arg("ids") = none, arg("ids_a") = none, arg("ids_b") = none, arg("closed") = true,
      arg("tolerance") = 0.0, arg("dimensions") = 3, arg("dtype") = "int64", arg("copy") = none,
      arg("invalid") = "warn", about_stream_pairs);
}

void add_near_searches(py::class_<PyDetector>& detector) {
  const py::none none;
  detector.def(
      "find_near_pairs",
      [](PyDetector& self, handle points, handle distance, handle radii, handle dimensions, handle dtype,
         handle max_pairs, handle invalid) {
        return self.find_near_pairs(
            std::make_shared<NearSearch>(NearArguments{points, distance, radii, dimensions, invalid}), dtype,
            max_pairs);
      },
      arg("points"), arg("distance"), py::kw_only(), arg("radii") = none, arg("dimensions") = 3, arg("dtype") = "int64",
      arg("max_pairs") = none, arg("invalid") = "warn", about_find_near_pairs);
  detector.def(
      "stream_near_pairs",
      [](PyDetector& self, handle points, handle distance, handle callback, handle block, handle radii,
         handle dimensions, handle dtype, handle invalid) {
        return self.stream_near_pairs(NearSearch({points, distance, radii, dimensions, invalid}), callback, block,
                                      dtype);
      },
      arg("points"), arg("distance"), arg("callback"), py::kw_only(), arg("block") = usual_block, arg("radii") = none,
      arg("dimensions") = 3, arg("dtype") = "int64", arg("invalid") = "warn", about_stream_near_pairs);
}

}  // namespace

void add_detector(py::module_& module) {
  const py::none none;
  py::class_<PyDetector> detector(module, "Detector", about);
  detector
      .def(py::init([](handle executor, handle method, handle cutoff) {
             return std::make_unique<PyDetector>(executor,
                                                 DetectorOptions{nullptr, method_of(method), cutoff_of(cutoff)});
           }),
           arg("executor") = none, py::kw_only(), arg("method") = "planned", arg("cutoff") = 0)
      .def_property_readonly(
          "stats", [](const PyDetector& self) { return self.stats(); },
          "Stats: of the last search that ended without an exception.")
      .def_property_readonly("scratch_bytes", &PyDetector::scratch_bytes,
                             "int: bytes of scratch memory that it keeps. RuntimeError while it searches.")
      .def("shrink_to_fit", &PyDetector::shrink_to_fit,
           "shrink_to_fit()\n\nGives all scratch memory back; the next search takes it anew.");
  add_searches(detector);
  add_near_searches(detector);
}

}  // namespace boxstream::python
