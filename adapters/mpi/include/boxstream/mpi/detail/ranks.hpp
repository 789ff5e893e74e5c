// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>

#include <mpi.h>

#include <boxstream/mpi/error.hpp>

namespace boxstream::mpi::detail {

/// For communicators whose errors return: others end the program.
inline void check(int code) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw std::runtime_error("boxstream: MPI: " + std::string(text, static_cast<std::size_t>(length)));
}

/// The ranks of a communicator, and what they have to agree on.
class Ranks {
 public:
  explicit Ranks(MPI_Comm comm) : comm_(comm) {
    check(MPI_Comm_rank(comm, &self_));
    check(MPI_Comm_size(comm, &size_));
  }

  MPI_Comm comm() const { return comm_; }
  int self() const { return self_; }
  int size() const { return size_; }

  std::uint64_t sum(std::uint64_t value) const { return reduce(value, MPI_SUM); }
  std::uint64_t max(std::uint64_t value) const { return reduce(value, MPI_MAX); }

  /// Does `step` on each rank. If it throws on one of them, all ranks throw. It must not wait for others.
  template <class Step>
  void together(Step&& step) const {
    std::exception_ptr thrown;
    try {
      step();
    } catch (...) {
      thrown = std::current_exception();
    }
    agree(thrown);
  }

 private:
  std::uint64_t reduce(std::uint64_t value, MPI_Op operation) const {
    check(MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_UINT64_T, operation, comm_));
    return value;
  }

  void agree(const std::exception_ptr& thrown) const {
    int first = thrown ? self_ : size_;
    check(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm_));
    if (first == size_) return;
    char what[256] = {};  // no allocation here: memory may be what is short
    if (first == self_) describe(thrown, what, sizeof what - 1);
    check(MPI_Bcast(what, sizeof what, MPI_CHAR, first, comm_));
    if (!thrown) throw Error(first, what);
    try {
      std::rethrow_exception(thrown);
    } catch (...) {
      std::throw_with_nested(Error(first, what));
    }
  }

  static void describe(const std::exception_ptr& thrown, char* text, std::size_t most) {
    const auto copy = [&](const char* what) {
      for (std::size_t i = 0; i < most && what[i] != '\0'; ++i) text[i] = what[i];
    };
    try {
      std::rethrow_exception(thrown);
    } catch (const std::exception& exception) {
      copy(exception.what());
    } catch (...) {
      copy("an exception of unknown type");
    }
  }

  MPI_Comm comm_;
  int self_ = 0, size_ = 0;
};

}  // namespace boxstream::mpi::detail
