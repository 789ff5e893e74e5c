// SPDX-License-Identifier: MIT
#include "boxstream/advice/hard_families.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "formats/scene_model/names.hpp"

namespace boxstream::tool {

extern const char* const hard_families_json;  // made from hard_families.json by CMake

namespace {

Family read_family(const nlohmann::json& document) {
  Family family{document.at("bodies"), {}, document.value("prices", std::vector<double>{})};
  for (const nlohmann::json& row : document.at("held"))
    family.rows.push_back({{row.at("steps_per_second"), row.at("iterations")}, row.at("loads")});
  return family;
}

/// 1/60 s is not exact, nor are masses.
constexpr double slack = 1 + 1e-6;

}  // namespace

bool Family::holds(const Column& column, const Fineness& fineness) const {
  const auto size = std::lower_bound(bodies.begin(), bodies.end(), column.bodies);
  if (size == bodies.end()) return false;
  const auto is_no_finer = [](const Row& row, const Fineness& than) {
    return row.fineness.steps_per_second <= than.steps_per_second * slack && row.fineness.iterations <= than.iterations;
  };
  // More iterations can bear less, so what a coarser row bore says nothing where a finer one was measured.
  const auto decides = [&](const Row& row) {
    return is_no_finer(row, fineness) && std::none_of(rows.begin(), rows.end(), [&](const Row& other) {
             return &other != &row && is_no_finer(row, other.fineness) && is_no_finer(other, fineness);
           });
  };
  return std::any_of(rows.begin(), rows.end(), [&](const Row& row) {
    return decides(row) && column.load <= row.loads[static_cast<std::size_t>(size - bodies.begin())] * slack;
  });
}

std::optional<Settings> Family::cheapest(const Column& column, const Fineness& least) const {
  std::optional<Settings> best;
  for (const int substeps : {1, 2, 3, 4, 6, 8, 12, 16})
    for (const Row& row : rows) {
      const Settings settings{substeps, std::max(row.fineness.iterations, least.iterations)};
      if (best && price_of(settings) >= price_of(*best)) continue;
      if (holds(column, {least.steps_per_second * substeps, settings.iterations})) best = settings;
    }
  return best;
}

const Families& measured_families() {
  static const Families families = [] {
    const nlohmann::json document = nlohmann::json::parse(hard_families_json);
    Families read;
    read.starts = document.at("starts");
    const auto take = [&](scenes::SolverKind kind, const nlohmann::json& of) {
      // Of a solver that makes no difference to it, a family was not measured.
      if (of.contains("stack")) read.stack[kind] = read_family(of.at("stack"));
      if (of.contains("awake")) read.awake[kind] = read_family(of.at("awake"));
      read.chain[kind] = read_family(of.at("chain"));
      read.hanging[kind] = read_family(of.at("hanging"));
    };
    take(scenes::SolverKind::sequential_impulses, document);
    const std::vector<std::string>& names = scenes::solver_names();
    for (const auto& [name, of] : document.at("solvers").items())
      take(static_cast<scenes::SolverKind>(std::find(names.begin(), names.end(), name) - names.begin()), of);
    return read;
  }();
  return families;
}

const Family& family_of(const std::map<scenes::SolverKind, Family>& families, scenes::SolverKind kind) {
  const auto found = families.find(kind);
  return found == families.end() ? families.at(scenes::SolverKind::sequential_impulses) : found->second;
}

double Family::price(const Column& column, const Settings& settings) const {
  if (prices.empty()) return price_of(settings) / double{price_of({1, 10})};
  const auto size = std::lower_bound(bodies.begin(), bodies.end(), column.bodies);
  const auto at = static_cast<std::size_t>(std::min(size, bodies.end() - 1) - bodies.begin());
  return prices[at] * price_of(settings) / price_of({1, 10});
}

}  // namespace boxstream::tool
