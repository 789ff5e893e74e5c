// SPDX-License-Identifier: MIT
#include <boxstream/near.hpp>

#include "nearest/exact_sum.hpp"

namespace boxstream::detail {

bool near_exactly(const Ball64& a, const Ball64& b, double distance) {
  ExactSum sum;
  for (int d = 0; d < 3; ++d) {
    const Digits x(a.centre[d]), y(b.centre[d]);
    sum.add(x, x, 1);
    sum.add(x, y, -2);
    sum.add(y, y, 1);
  }
  const Digits reach[] = {Digits(a.radius), Digits(b.radius), Digits(distance)};
  for (int i = 0; i < 3; ++i) {
    sum.add(reach[i], reach[i], -1);
    for (int j = 0; j < i; ++j) sum.add(reach[i], reach[j], -2);
  }
  return sum.sign() <= 0;
}

}  // namespace boxstream::detail
