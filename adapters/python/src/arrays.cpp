// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <bit>
#include <limits>

namespace boxstream::python {

static_assert(sizeof(Aabb) == 6 * sizeof(float) && sizeof(Aabb64) == 6 * sizeof(double));
static_assert(sizeof(IntAabb) == 6 * sizeof(std::int32_t) && sizeof(IntAabb64) == 6 * sizeof(std::int64_t));
static_assert(sizeof(ProxyId) == sizeof(std::uint64_t) && std::endian::native == std::endian::little);

namespace {

std::string shape_text(const char* first, const Element& element) {
  std::string text = std::string("(") + first;
  for (const py::ssize_t length : element) text += ", " + std::to_string(length);
  return text + (element.empty() ? ",)" : ")");
}

std::string dtypes_text(const Wanted& wanted) {
  if (wanted.owner != nullptr) return text_of(dtype_of(wanted.scalar)) + ", as " + wanted.owner + ",";
  return wanted.integers ? "floats or integers" : "floats";
}

/// What the caller has to give; made for messages alone, because names of types import modules, which may be gone at
/// the end.
using Expected = FunctionRef<std::string()>;

std::string expected_text(const char* name, const Wanted& wanted) {
  std::string text = std::string(name) + ": expected an array of " + dtypes_text(wanted) + " of shape ";
  for (std::size_t i = 0; i < wanted.elements.size(); ++i)
    text += (i == 0 ? "" : " or ") + shape_text("n", wanted.elements[i]);
  return text + ", got ";
}

std::string shape_of(const py::array& array) {
  return text_of(array.dtype()) + " of shape " + text_of(array.attr("shape"));
}

bool has_shape(const py::array& array, const Element& element) {
  if (array.ndim() != static_cast<py::ssize_t>(element.size()) + 1) return false;
  for (std::size_t i = 0; i < element.size(); ++i)
    if (array.shape(static_cast<py::ssize_t>(i) + 1) != element[i]) return false;
  return true;
}

bool has_shape(const py::array& array, const std::vector<Element>& elements) {
  return std::any_of(elements.begin(), elements.end(), [&](const Element& each) { return has_shape(array, each); });
}

/// What helps where the shape is wrong.
std::string shape_hint(const char* name, const py::array& array, const Wanted& wanted) {
  const Element& element = wanted.elements[0];
  const std::string of = name;
  const bool are_boxes = wanted.elements.size() == 2;
  if (element.empty()) return array.ndim() > 1 && array.size() == array.shape(0) ? ": " + of + ".ravel() has it" : "";
  const py::ssize_t columns = element[0];
  if (array.ndim() == 1 && array.shape(0) == columns) return ": one is " + of + "[numpy.newaxis]";
  if (array.ndim() == 1 && array.shape(0) % columns == 0)
    return ": " + of + ".reshape(-1, " + std::to_string(columns) + ") has it";
  // A World, and all that has dimensions already, takes no other ones.
  const auto other_dimensions = [&](py::ssize_t d) {
    const std::string given = std::to_string(d);
    if (wanted.owner == nullptr)
      return (are_boxes ? ": boxes of " : ": points of ") + given + " dimensions take dimensions=" + given;
    return ": these seem to have " + given + (are_boxes ? " dimensions; the others are from 0 to 1" : " dimensions");
  };
  if (array.ndim() == 3 && are_boxes) {
    if (array.shape(1) == columns / 2 && array.shape(2) == 2) return ": " + of + ".transpose(0, 2, 1) has it";
    if (array.shape(1) == 2 && array.shape(2) < 3) return other_dimensions(array.shape(2));
  }
  if (array.ndim() == 3 && are_boxes && array.shape(2) == columns / 2) {
    if (array.shape(0) == 2) return ": " + of + ".swapaxes(0, 1) has it";
    return ": numpy.hstack([" + of + ".min(axis=1), " + of + ".max(axis=1)]) makes boxes of corners";
  }
  if (array.ndim() != 2) return "";
  const py::ssize_t given = array.shape(1);
  if (are_boxes && (given == 2 || given == 4 || given == 6)) return other_dimensions(given / 2);
  if (!are_boxes && given < columns) return other_dimensions(given);
  if (columns == 3 && given == 4)
    return ": if the fourth column has radii, " + of + "[:, :3] and radii=" + of + "[:, 3]; if not, " + of +
           "[:, :3] alone";
  if (array.shape(0) == columns) return ": " + of + ".T has it";
  return "";
}

/// What helps where the numbers are none that the library takes.
std::string dtype_hint(const char* name, const py::array& array) {
  const std::string of = name;
  switch (array.dtype().kind()) {
    case 'u':
      return " beyond int64: " + of + ".astype(numpy.float64) rounds them";
    case 'b':
    case 'M':
    case 'm':
      return ": " + of + ".astype(numpy.int64) makes integers of them";
    case 'f':
      return ": " + of + ".astype(numpy.float64) rounds them";
    case 'U':
    case 'S':
      if (array.ndim() == 0) return ": numpy.frombuffer(" + of + ", ...) makes numbers of bytes";
      return ": numpy.asarray(" + of + ", float) reads them";
    case 'V':
      return ": numpy.lib.recfunctions.structured_to_unstructured(" + of + ") makes columns of its fields";
    case 'O':
      if (array.ndim() == 0) return ", of an object that is no sequence: list(" + of + ") may be one";
      return ": numpy.asarray(" + of + ", float) makes floats of them, if they are numbers";
    default:
      return "";
  }
}

bool is_aligned(const py::array& array) {
  return (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

bool is_in_c_order(const py::array& array) {
  return (array.flags() & py::array::c_style) != 0;
}

/// Whether it is NumPy's own class, which has no masks.
bool is_plain(py::handle given) {
  return reinterpret_cast<PyTypeObject*>(py::detail::npy_api::get().PyArray_Type_) == Py_TYPE(given.ptr());
}

py::module_ numpy() {
  return py::module_::import("numpy");
}

/// The array itself, or what NumPy makes of other objects that have numbers.
py::array any_array(py::handle given, const char* name, Expected expected) {
  if (is_plain(given)) return py::reinterpret_borrow<py::array>(given);
  if (py::isinstance<py::array>(given)) {
    const py::object masked = numpy().attr("ma");
    if (masked.attr("is_masked")(given).cast<bool>())
      throw py::value_error(std::string(name) + ": has masked elements: " + name +
                            ".filled(numpy.nan) makes theirs invalid, numpy.ma.compress_rows drops them");
    return numpy().attr("asarray")(given);
  }
  if (given.is_none() || py::isinstance<py::str>(given) || PyNumber_Check(given.ptr()) != 0)
    if (!py::hasattr(given, "__array__")) throw py::type_error(expected() + "an object of type " + type_of(given));
  try {
    return numpy().attr("asarray")(given);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    throw py::value_error(expected() + "what NumPy makes no array of: " + text_of(error.value()));
  }
}

bool has_dtype(const py::array& array, Scalar scalar) {
  return array.dtype().equal(dtype_of(scalar));
}

/// Whether all of an array of uint64 are numbers of int64, too.
bool is_within_int64(const py::array& array) {
  // As Python's: NumPy compares the two types as doubles.
  return array.size() == 0 || py::int_(array.attr("max")()) <= py::int_(std::numeric_limits<std::int64_t>::max());
}

/// The type of the library that has all numbers of an array's type, if there is one; of uint64, all of the array's.
bool fitting_scalar(const py::array& array, Scalar& scalar) {
  const char kind = array.dtype().kind();
  const py::ssize_t size = array.dtype().itemsize();
  if (kind == 'f' && size <= 8)
    scalar = size == 8 ? Scalar::float64 : Scalar::float32;
  else if (kind == 'i' || (kind == 'u' && (size <= 4 || is_within_int64(array))))
    scalar = size < 4 || (size == 4 && kind == 'i') ? Scalar::int32 : Scalar::int64;
  else
    return false;
  return true;
}

py::array converted(const py::array& array, Scalar scalar) {
  return numpy().attr("require")(array, dtype_of(scalar), "CA");
}

/// NumPy says nothing of floating-point errors while this lives.
class QuietNumPy {
 public:
  QuietNumPy() : state_(numpy().attr("errstate")(py::arg("all") = "ignore")) { state_.attr("__enter__")(); }
  ~QuietNumPy() {
    try {
      state_.attr("__exit__")(py::none(), py::none(), py::none());
    } catch (py::error_already_set& error) {
      error.discard_as_unraisable(__func__);
    }
  }
  QuietNumPy(const QuietNumPy&) = delete;
  QuietNumPy& operator=(const QuietNumPy&) = delete;

 private:
  py::object state_;
};

/// A copy of another type, and whether it has the same numbers.
std::pair<py::array, bool> copy_of(const py::array& array, Scalar scalar) {
  const QuietNumPy quiet;
  const py::array copy = converted(array, scalar);
  const py::object back = copy.attr("astype")(array.dtype());
  const bool has_nans = array.dtype().kind() == 'f';
  return {copy, numpy().attr("array_equal")(array, back, py::arg("equal_nan") = has_nans).cast<bool>()};
}

/// A copy of another type, refused if a number differs.
py::array converted_exactly(const py::array& array, Scalar scalar, Expected expected, const char* name) {
  const auto [copy, is_same] = copy_of(array, scalar);
  if (is_same) return copy;
  const std::string dtype = text_of(dtype_of(scalar));
  throw py::type_error(expected() + text_of(array.dtype()) + " that it does not have: numpy.asarray(" + name +
                       ", numpy." + dtype + ") rounds");
}

[[noreturn]] void refuse_copy(const py::array& array, bool is_own, Expected expected) {
  if (!is_own) throw py::value_error(expected() + "what has to be copied, which copy=False forbids");
  if (!is_in_c_order(array))
    throw py::value_error(expected() + text_of(array.dtype()) + " with strides " + text_of(array.attr("strides")) +
                          ", which is not C order, and copy=False forbids a copy");
  if (!is_aligned(array))
    throw py::value_error(expected() + text_of(array.dtype()) + " that is not aligned, and copy=False forbids a copy");
  throw py::value_error(expected() + text_of(array.dtype()) + ", and copy=False forbids a copy");
}

template <class S>
void pad_boxes(const S* from, std::size_t count, int dimensions, S* to) {
  for (std::size_t i = 0; i < count; ++i)
    for (int end = 0; end < 2; ++end)
      for (int d = 0; d < 3; ++d) *to++ = d < dimensions ? *from++ : static_cast<S>(end);
}

template <class T>
constexpr const char* dtype_name = std::is_same_v<T, std::uint32_t>  ? "uint32"
                                   : std::is_same_v<T, std::int64_t> ? "int64"
                                                                     : "uint64";

}  // namespace

py::dtype dtype_of(Scalar scalar) {
  switch (scalar) {
    case Scalar::float32:
      return py::dtype::of<float>();
    case Scalar::float64:
      return py::dtype::of<double>();
    case Scalar::int32:
      return py::dtype::of<std::int32_t>();
    case Scalar::int64:
      break;
  }
  return py::dtype::of<std::int64_t>();
}

py::bytes bytes_of(py::handle given, const char* name) {
  if (!PyObject_CheckBuffer(given.ptr()))
    throw py::type_error(std::string(name) + ": expected bytes, got an object of type " + type_of(given));
  PyObject* const bytes = PyBytes_FromObject(given.ptr());
  if (bytes == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(bytes);
}

Numbers::Numbers(py::handle given, const char* name, const Wanted& wanted) {
  const auto expected = [&] { return expected_text(name, wanted); };
  array_ = any_array(given, name, expected);
  Scalar scalar{};
  const bool fits = fitting_scalar(array_, scalar);
  const bool is_empty = array_.ndim() == 1 && array_.shape(0) == 0;  // as of an empty list
  if (!fits && !is_empty) throw py::type_error(expected() + text_of(array_.dtype()) + dtype_hint(name, array_));
  if (is_empty && !wanted.elements[0].empty()) {
    py::list shape;
    shape.append(0);
    for (const py::ssize_t length : wanted.elements[0]) shape.append(length);
    array_ = array_.attr("reshape")(shape);
  }
  if (!has_shape(array_, wanted.elements))
    throw py::value_error(expected() + shape_of(array_) + shape_hint(name, array_, wanted));
  const bool is_float = scalar == Scalar::float32 || scalar == Scalar::float64;
  scalar_ = wanted.owner != nullptr ? wanted.scalar : is_float || wanted.integers ? scalar : Scalar::float64;
  const bool is_own = py::isinstance<py::array>(given);  // of which array_ is at most another view
  if (is_own && has_dtype(array_, scalar_) && is_in_c_order(array_) && is_aligned(array_)) return;
  if (!wanted.may_copy) refuse_copy(array_, is_own, expected);
  const boxstream::detail::DefaultFloatEnvironment environment;  // rounding may be a trap of the caller's
  array_ = scalar_ == scalar ? converted(array_, scalar_) : converted_exactly(array_, scalar_, expected, name);
}

namespace {

Wanted boxes_of(const BoxFormat& format) {
  const py::ssize_t d = format.dimensions;
  Wanted wanted{{{2 * d}, {2, d}}};
  wanted.integers = true;
  wanted.may_copy = format.may_copy;
  return wanted;
}

Wanted boxes_as(Scalar scalar, const char* owner, py::ssize_t dimensions, bool may_copy) {
  Wanted wanted{{{2 * dimensions}, {2, dimensions}}};
  wanted.owner = owner;
  wanted.scalar = scalar;
  wanted.may_copy = may_copy;
  return wanted;
}

}  // namespace

Boxes::Boxes(py::handle given, const char* name, const BoxFormat& format) : numbers_(given, name, boxes_of(format)) {
  if (format.dimensions < 3) {
    if (!format.may_copy)
      throw py::value_error(std::string(name) +
                            ": boxes of fewer than three dimensions are copied, which copy=False forbids");
    pad(format.dimensions);
  }
  check(name, format.invalid);
}

Boxes::Boxes(py::handle given, const char* name, Invalid invalid, Scalar scalar, const char* owner, int dimensions,
             bool may_copy)
    : numbers_(given, name, boxes_as(scalar, owner, dimensions, may_copy)) {
  if (dimensions < 3) pad(dimensions);
  check(name, invalid);
}

void Boxes::pad(int dimensions) {
  with_scalar(numbers_.scalar(), [&](auto s) {
    using S = decltype(s);
    padded_.resize(std::max<std::size_t>((size() * 6 * sizeof(S) + 7) / 8, 1));
    pad_boxes(numbers_.data<S>(), size(), dimensions, reinterpret_cast<S*>(padded_.data()));
  });
}

void Boxes::check(const char* name, Invalid invalid) const {
  if (invalid != Invalid::raise) return;
  with_scalar(numbers_.scalar(), [&](auto s) {
    using S = decltype(s);
    require_valid(as<S>(), name, "a NaN, or min > max", [](const BasicAabb<S>& box) { return is_valid(box); });
  });
}

template <class T>
std::vector<T> integers_of(py::handle given, const char* name, std::size_t size, const char* fix) {
  const auto expected = [&] { return std::string(name) + ": expected integers of shape (n,), got "; };
  py::array array = any_array(given, name, expected);
  const char kind = array.dtype().kind();
  const bool is_empty = array.ndim() == 1 && array.shape(0) == 0;
  if (kind != 'i' && kind != 'u' && !is_empty) throw py::type_error(expected() + text_of(array.dtype()) + fix);
  if (array.ndim() != 1) throw py::value_error(expected() + shape_of(array));
  const auto count = static_cast<std::size_t>(array.shape(0));
  if (size != any_size && count != size)
    throw py::value_error(std::string(name) + ": expected " + std::to_string(size) + " elements, got " +
                          std::to_string(count));
  const auto copy = [&](auto item) {
    using Item = decltype(item);
    const auto dtype = py::dtype::of<Item>();
    if (!array.dtype().equal(dtype) || !is_in_c_order(array) || !is_aligned(array))
      array = numpy().attr("require")(array, dtype, "CA");
    const auto* const items = static_cast<const Item*>(array.data());
    std::vector<T> values(count);
    bool fit = true;
    for (std::size_t i = 0; i < count; ++i) {
      const Item value = items[i];  // read once: another thread may change it
      fit = fit && std::in_range<T>(value);
      values[i] = static_cast<T>(value);
    }
    if (!fit) throw py::value_error(std::string(name) + ": expected integers that " + dtype_name<T> + " has" + fix);
    return values;
  };
  if (kind == 'u' && array.dtype().itemsize() == 8) return copy(std::uint64_t{});
  if (kind == 'u' && array.dtype().itemsize() == 4) return copy(std::uint32_t{});
  return copy(std::int64_t{});
}

template std::vector<std::uint32_t> integers_of(py::handle, const char*, std::size_t, const char*);
template std::vector<std::uint64_t> integers_of(py::handle, const char*, std::size_t, const char*);
template std::vector<std::int64_t> integers_of(py::handle, const char*, std::size_t, const char*);

std::vector<Filter> filters_of(py::handle groups, py::handle masks, std::size_t size, const std::string& which) {
  std::vector<Filter> filters;
  if (groups.is_none() && masks.is_none()) return filters;
  filters.resize(size);
  const auto fill = [&](py::handle given, const std::string& name, std::uint32_t Filter::*member) {
    if (given.is_none()) return;
    const std::vector<std::uint32_t> values = integers_of<std::uint32_t>(
        given, name.c_str(), size, "; numpy.asarray(x).astype(numpy.uint32) has the bits of integers below 0");
    for (std::size_t i = 0; i < size; ++i) filters[i].*member = values[i];
  };
  fill(groups, "groups" + which, &Filter::group);
  fill(masks, "masks" + which, &Filter::mask);
  return filters;
}

std::vector<ProxyId> ids_of(py::handle given, const char* name) {
  const std::vector<std::uint64_t> numbers = integers_of<std::uint64_t>(given, name);
  const auto* const ids = reinterpret_cast<const ProxyId*>(numbers.data());
  return {ids, ids + numbers.size()};
}

Indices indices_of(py::handle given) {
  const py::dtype dtype = py::dtype::from_args(py::reinterpret_borrow<py::object>(given));
  if (dtype.equal(py::dtype::of<std::int64_t>())) return Indices::int64;
  if (dtype.equal(py::dtype::of<std::int32_t>())) return Indices::int32;
  if (dtype.equal(py::dtype::of<std::uint32_t>())) return Indices::uint32;
  throw py::type_error("dtype: expected int64, int32 or uint32, got " + text_of(dtype));
}

}  // namespace boxstream::python
