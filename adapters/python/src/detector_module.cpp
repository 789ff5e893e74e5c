// SPDX-License-Identifier: MIT
// Detector as Python sees it, and the functions that make one, use it once and drop it.
#include "detector.hpp"

namespace boxstream::python {

namespace {

constexpr const char* about_find_pairs =
    R"(find_pairs(boxes, other=None, groups=None, masks=None, *, {executor}invalid='skip')

Every pair of boxes that overlap or touch, each exactly once.

boxes: array of float32 or float64, shape (n, 6) or (n, 2, 3): the minima of a box, then its maxima. In C order; it is
    read where it lies, and should not change during the call: pairs of what changes are wrong then.
other: as boxes and of the same dtype, or None. If given, pairs of one of boxes and one of other are found.
groups, masks: arrays of uint32, shape (n,), or None. Two boxes may pair if each one's group has a bit in common with
    the other's mask. Defaults: group 1, mask 0xffffffff. With other, a tuple of two arrays or None.
{about_executor}invalid: 'skip': boxes with a NaN or with min > max pair with nothing. 'raise': they are a ValueError.

Returns an array of uint32, shape (k, 2), over the memory that the search filled: indices of boxes, a < b; with other,
indices of boxes and of other. The order depends on the boxes alone, not on threads.
Raises TypeError for a wrong type of object or dtype, ValueError for a wrong shape, order, size or number.
Other Python threads run meanwhile. Ctrl-C has an effect after the call: see stream_pairs.)";

constexpr const char* about_find_pairs_in_sets =
    R"(find_pairs_in_sets(boxes, offsets, other=None, other_offsets=None, groups=None, masks=None, *, {executor}invalid='skip')

Many searches in one call, such as those of many small worlds: every pair of boxes of the same set.

boxes: as in find_pairs, one set after the other.
offsets: array of int64 or uint64, shape (m + 1,), for m sets: set i has boxes[offsets[i]:offsets[i + 1]]. They ascend
    from 0 to n; equal ones make an empty set. From the world of each box, in ascending order:
    numpy.searchsorted(world, numpy.arange(m + 1)).
other, other_offsets: None, or as many sets more, as boxes and offsets. Then pairs of one box of set i of boxes and one of
    set i of other are found.
groups, masks: as in find_pairs, for all boxes.
{about_executor}invalid: as in find_pairs.

Returns two arrays, over the memory that the search filled: pairs, uint32, shape (k, 2), and pair_offsets, uint64, shape
(m + 1,). The pairs of set i are pairs[pair_offsets[i]:pair_offsets[i + 1]], in the order of a search of its own. They are
indices of boxes, a < b; with other, of boxes and of other. Errors: as find_pairs.)";

constexpr const char* about_stream_pairs =
    R"(stream_pairs(boxes, callback, other=None, groups=None, masks=None, *, block=65536, {executor}invalid='skip')

The pairs of find_pairs, in the same order, passed to a callable block by block while they are found. Memory does not
grow with the number of pairs.

callback: called with an array of uint32, shape (m, 2), which it may keep; m is block, and less in the last call. If it
    returns False (the object itself), the search stops. What it raises passes through.
block: int above 0: pairs for each call.
{about_executor}Other parameters and errors: as find_pairs.

Returns an int: how many pairs were passed on. A signal handler's exception, such as KeyboardInterrupt, stops the
search within a twentieth of a second of the next pairs.)";

constexpr const char* about_find_near_pairs = R"(find_near_pairs(balls, distance, *, {executor}invalid='skip')

Every pair of balls or points with a gap of at most distance: |a - b| <= radius(a) + radius(b) + distance, decided
without rounding.

balls: array of float32 or float64, shape (n, 4): centre and radius, read where it lies; or (n, 3): points. C order.
distance: float, finite, not below 0; rounded to the dtype of balls.
{about_executor}invalid: 'skip': balls with a number that is not finite, or a radius below 0, are near nothing. 'raise':
    they are a ValueError.

Returns an array of uint32, shape (k, 2): indices of balls, a < b. Errors: as find_pairs.)";

constexpr const char* about_stream_near_pairs =
    R"(stream_near_pairs(balls, distance, callback, *, block=65536, {executor}invalid='skip')

The pairs of find_near_pairs, in the same order, passed to callback block by block: see stream_pairs.
{about_executor}
Returns an int: how many pairs were passed on.)";

/// The text for a function, which takes an executor, or for a method, whose Detector has one.
std::string text(const char* about, bool is_function) {
  std::string result = about;
  const auto replace = [&](const std::string& mark, const char* by) {
    const std::size_t at = result.find(mark);
    if (at != std::string::npos) result.replace(at, mark.size(), is_function ? by : "");
  };
  replace("{executor}", "executor=None, ");
  replace("{about_executor}", "executor: Executor, or None for the calling thread.\n");
  return result;
}

constexpr std::size_t usual_block = 65536;

void add_class(py::module_& module) {
  using py::arg;
  const py::none none;
  py::class_<PyDetector>(module, "Detector", R"(Detector(executor=None, *, method='planned', cutoff=0)

Searches that keep their scratch memory from one to the next. For use by one thread at a time; RuntimeError otherwise.

executor: Executor, or None for the calling thread.
method: how pairs are found; which ones they are does not depend on it. 'planned': the fastest for nearly all boxes.
    'hybrid': the streamed segment tree with scans of Zomorodian and Edelsbrunner, Fast software for box intersections,
    alone: several times slower, and worth comparing with.
cutoff: int, of 'hybrid': it scans nodes with fewer intervals or points than that. 0: samples tell when.)")
      .def(py::init([](py::handle executor, py::handle method, py::handle cutoff) {
             return std::make_unique<PyDetector>(executor,
                                                 DetectorOptions{nullptr, method_of(method), cutoff_of(cutoff)});
           }),
           arg("executor") = none, py::kw_only(), arg("method") = "planned", arg("cutoff") = 0)
      .def("find_pairs", &PyDetector::find_pairs, arg("boxes"), arg("other") = none, arg("groups") = none,
           arg("masks") = none, py::kw_only(), arg("invalid") = "skip", text(about_find_pairs, false).c_str())
      .def("find_pairs_in_sets", &PyDetector::find_pairs_in_sets, arg("boxes"), arg("offsets"), arg("other") = none,
           arg("other_offsets") = none, arg("groups") = none, arg("masks") = none, py::kw_only(),
           arg("invalid") = "skip", text(about_find_pairs_in_sets, false).c_str())
      .def("stream_pairs", &PyDetector::stream_pairs, arg("boxes"), arg("callback"), arg("other") = none,
           arg("groups") = none, arg("masks") = none, py::kw_only(), arg("block") = usual_block,
           arg("invalid") = "skip", text(about_stream_pairs, false).c_str())
      .def("find_near_pairs", &PyDetector::find_near_pairs, arg("balls"), arg("distance"), py::kw_only(),
           arg("invalid") = "skip", text(about_find_near_pairs, false).c_str())
      .def("stream_near_pairs", &PyDetector::stream_near_pairs, arg("balls"), arg("distance"), arg("callback"),
           py::kw_only(), arg("block") = usual_block, arg("invalid") = "skip",
           text(about_stream_near_pairs, false).c_str())
      .def_property_readonly(
          "stats", [](const PyDetector& self) { return self.stats(); },
          "Stats: of the last search that ended without an exception.")
      .def_property_readonly("scratch_bytes", &PyDetector::scratch_bytes,
                             "int: bytes of scratch memory that it keeps.");
}

void add_functions(py::module_& module) {
  using py::arg;
  const py::none none;
  module.def(
      "find_pairs",
      [](py::handle boxes, py::handle other, py::handle groups, py::handle masks, py::handle executor,
         py::handle invalid) { return PyDetector(executor).find_pairs(boxes, other, groups, masks, invalid); },
      arg("boxes"), arg("other") = none, arg("groups") = none, arg("masks") = none, py::kw_only(),
      arg("executor") = none, arg("invalid") = "skip", text(about_find_pairs, true).c_str());
  module.def(
      "find_pairs_in_sets",
      [](py::handle boxes, py::handle offsets, py::handle other, py::handle other_offsets, py::handle groups,
         py::handle masks, py::handle executor, py::handle invalid) {
        return PyDetector(executor).find_pairs_in_sets(boxes, offsets, other, other_offsets, groups, masks, invalid);
      },
      arg("boxes"), arg("offsets"), arg("other") = none, arg("other_offsets") = none, arg("groups") = none,
      arg("masks") = none, py::kw_only(), arg("executor") = none, arg("invalid") = "skip",
      text(about_find_pairs_in_sets, true).c_str());
  module.def(
      "stream_pairs",
      [](py::handle boxes, py::handle callback, py::handle other, py::handle groups, py::handle masks, py::handle block,
         py::handle executor, py::handle invalid) {
        return PyDetector(executor).stream_pairs(boxes, callback, other, groups, masks, block, invalid);
      },
      arg("boxes"), arg("callback"), arg("other") = none, arg("groups") = none, arg("masks") = none, py::kw_only(),
      arg("block") = usual_block, arg("executor") = none, arg("invalid") = "skip",
      text(about_stream_pairs, true).c_str());
  module.def(
      "find_near_pairs",
      [](py::handle balls, py::handle distance, py::handle executor, py::handle invalid) {
        return PyDetector(executor).find_near_pairs(balls, distance, invalid);
      },
      arg("balls"), arg("distance"), py::kw_only(), arg("executor") = none, arg("invalid") = "skip",
      text(about_find_near_pairs, true).c_str());
  module.def(
      "stream_near_pairs",
      [](py::handle balls, py::handle distance, py::handle callback, py::handle block, py::handle executor,
         py::handle invalid) {
        return PyDetector(executor).stream_near_pairs(balls, distance, callback, block, invalid);
      },
      arg("balls"), arg("distance"), arg("callback"), py::kw_only(), arg("block") = usual_block, arg("executor") = none,
      arg("invalid") = "skip", text(about_stream_near_pairs, true).c_str());
}

}  // namespace

void add_detector(py::module_& module) {
  add_class(module);
  add_functions(module);
}

}  // namespace boxstream::python
