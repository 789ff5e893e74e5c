// SPDX-License-Identifier: MIT
#include "mesh/expansion.hpp"

#include <cmath>

namespace boxstream::mesh {
namespace {

/// A rounded result and what rounding took away.
struct Rounded {
  double value, error;
};

Rounded sum(double a, double b) {
  const double value = a + b;
  const double b_in_it = value - a;
  const double a_in_it = value - b_in_it;
  return {value, (a - a_in_it) + (b - b_in_it)};
}

Rounded product(double a, double b) {
  const double value = a * b;
  return {value, std::fma(a, b, -value)};
}

}  // namespace

Expansion Expansion::difference(double a, double b) {
  const Rounded d = sum(a, -b);
  Expansion result;
  if (d.error != 0) result.terms_.push_back(d.error);
  if (d.value != 0) result.terms_.push_back(d.value);
  return result;
}

void Expansion::add(double term) {
  std::size_t kept = 0;
  for (const double t : terms_) {
    const Rounded s = sum(term, t);
    term = s.value;
    if (s.error != 0) terms_[kept++] = s.error;
  }
  terms_.resize(kept);
  if (term != 0) terms_.push_back(term);
}

Expansion Expansion::times(double factor) const {
  Expansion result;
  double carried = 0;
  const auto keep = [&](double error) {
    if (error != 0) result.terms_.push_back(error);
  };
  for (const double t : terms_) {
    const Rounded p = product(t, factor);
    const Rounded low = sum(carried, p.error);
    keep(low.error);
    const Rounded high = sum(p.value, low.value);
    keep(high.error);
    carried = high.value;
  }
  keep(carried);
  return result;
}

Expansion operator+(const Expansion& a, const Expansion& b) {
  Expansion result = a;
  for (const double t : b.terms_) result.add(t);
  return result;
}

Expansion operator-(const Expansion& a, const Expansion& b) {
  Expansion result = a;
  for (const double t : b.terms_) result.add(-t);
  return result;
}

Expansion operator*(const Expansion& a, const Expansion& b) {
  Expansion result;
  for (const double t : b.terms_) result = result + a.times(t);
  return result;
}

int Expansion::sign() const {
  if (terms_.empty()) return 0;
  return terms_.back() > 0 ? 1 : -1;
}

}  // namespace boxstream::mesh
