// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <new>
#include <stdexcept>

#include <boxstream/boxstream.h>

namespace boxstream::c {

/// Keeps the text for boxstream_error_text().
boxstream_status fail(boxstream_status status, const char* text) noexcept;

/// What `work` throws becomes a status: no exception passes into C.
template <class Work>
boxstream_status guarded(Work work) noexcept {
  try {
    work();
    return BOXSTREAM_OK;
  } catch (const std::bad_alloc&) {
    return fail(BOXSTREAM_NO_MEMORY, "out of memory");
  } catch (const std::length_error& error) {
    return fail(BOXSTREAM_TOO_MANY, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(BOXSTREAM_BAD_ARGUMENT, error.what());
  } catch (const std::exception& error) {
    return fail(BOXSTREAM_FAILED, error.what());
  } catch (...) {
    return fail(BOXSTREAM_FAILED, "an unknown exception");
  }
}

/// A pointer that must not be null.
template <class T>
T& need(T* pointer, const char* what) {
  if (pointer == nullptr) throw std::invalid_argument(what);
  return *pointer;
}

}  // namespace boxstream::c
