// SPDX-License-Identifier: MIT
#include "ids.hpp"

namespace boxstream::javascript {

namespace {
constexpr double two_to_32 = 4294967296.0, end_of_integers = 9007199254740992.0;
constexpr std::uint32_t told = (1u << 21) - 1;
}  // namespace

double Ids::number(ProxyId id) {
  if (!id) return 0;
  return two_to_32 * ((id.generation - 1) & told) + id.slot + 1.0;
}

void Ids::note(ProxyId id) {
  if (id.slot >= generations_.size()) generations_.resize(id.slot + std::size_t{1});
  generations_[id.slot] = id.generation;
}

ProxyId Ids::id(double number) const {
  if (!(number >= 1 && number < end_of_integers)) return {};
  const auto bits = static_cast<std::uint64_t>(number - 1);
  const auto slot = static_cast<std::uint32_t>(bits);
  if (slot >= generations_.size()) return {};
  const ProxyId last{slot, generations_[slot]};
  return this->number(last) == number ? last : ProxyId{};
}

std::vector<ProxyId> Ids::ids(Span<const double> numbers) const {
  std::vector<ProxyId> all(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) all[i] = id(numbers[i]);
  return all;
}

}  // namespace boxstream::javascript
