// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <variant>

#include "arrays.hpp"
#include "signals.hpp"

namespace boxstream::python {

/// A BoxIndex of float32 or float64 whose calls take and give arrays. It never changes: any number may ask at once.
class PyBoxIndex {
 public:
  PyBoxIndex(py::handle boxes, py::handle dimensions, py::handle copy, py::handle invalid);
  /// Of what `save` gave.
  PyBoxIndex(const py::bytes& saved, py::handle dimensions);

  py::bytes save() const;

  Scalar scalar() const { return indices_.index() == 0 ? Scalar::float32 : Scalar::float64; }
  int dimensions() const { return dimensions_; }
  std::size_t size() const;
  py::array bounds() const;

  py::array query_boxes(py::handle boxes, py::handle dtype) const;
  py::tuple query_rays(py::handle origins, py::handle directions, py::handle lengths) const;
  py::tuple cast_rays(py::handle origins, py::handle directions, py::handle lengths) const;
  py::array query_nearest(py::handle points, py::handle count) const;

 private:
  int dimensions_;
  std::variant<BoxIndex, BoxIndex64> indices_;
};

void add_box_index(py::module_& module);

}  // namespace boxstream::python
