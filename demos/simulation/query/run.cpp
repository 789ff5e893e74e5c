// SPDX-License-Identifier: MIT
#include "simulation/query/run.hpp"

#include <fcl/config.h>
#include <fmt/format.h>

#include <algorithm>

namespace boxstream::query {
namespace {

QueryStep numbers_of(const Answer& answer) {
  return {answer.callbacks, answer.skipped,  answer.failures, answer.hits.size(), answer.contacts,
          answer.touching,  answer.distance, answer.broad_ms, answer.narrow_ms};
}

std::vector<std::size_t> touched_objects(const QueryScene& scene, const std::vector<Answer>& answers) {
  std::vector<std::size_t> touched;
  for (std::size_t q = 0; q < answers.size(); ++q) {
    if (!scene.queries[q].b && scene.groups.size() > 1) continue;
    for (const Hit& hit : answers[q].hits) touched.insert(touched.end(), {hit.a, hit.b});
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

std::string pair_text(const ObjectMotion& motion, const Hit& hit) {
  return fmt::format("{} - {}", motion.name(hit.a), motion.name(hit.b));
}

std::string only_one_has(const ObjectMotion& motion, const Hit& hit, const std::string& has,
                         const std::string& has_not) {
  return fmt::format("{}: found by {}, not by {}", pair_text(motion, hit), has, has_not);
}

std::string value_text(const Query& query, const Hit& hit) {
  return query.kind == Kind::within ? fmt::format("at {:.17g}", hit.distance)
                                    : fmt::format("{} contacts", hit.contacts);
}

std::string hits_difference(const Query& query, const ObjectMotion& motion, const std::string& name_x, const Answer& x,
                            const std::string& name_y, const Answer& y) {
  const auto [i, j] = std::mismatch(x.hits.begin(), x.hits.end(), y.hits.begin(), y.hits.end());
  const bool end_x = i == x.hits.end(), end_y = j == y.hits.end();
  if (end_x && end_y) return {};
  if (!end_x && !end_y && i->a == j->a && i->b == j->b)
    return fmt::format("{}: {} {}, {} {}", pair_text(motion, *i), name_x, value_text(query, *i), name_y,
                       value_text(query, *j));
  const bool in_x = end_y || (!end_x && std::pair(i->a, i->b) < std::pair(j->a, j->b));
  return in_x ? only_one_has(motion, *i, name_x, name_y) : only_one_has(motion, *j, name_y, name_x);
}

}  // namespace

RunResult run(const QueryScene& scene, const std::string& manager, const std::optional<std::string>& compare,
              std::uint64_t steps, const Progress& progress) {
  ObjectMotion motion(scene);
  Objects objects(scene, motion);
  std::vector<Contestant> contestants;
  contestants.emplace_back(manager, scene, motion, objects);
  if (compare) contestants.emplace_back(*compare, scene, motion, objects);

  RunResult result;
  result.objects = motion.objects().size();
  for (std::size_t g = 0; g < scene.groups.size(); ++g)
    result.groups.push_back({scene.groups[g].name, objects.all_of(g).size(), objects.moving_of(g).size()});
  for (const Contestant& c : contestants) result.managers.push_back({c.name(), c.register_ms(), {}});
  if (compare) result.answers_equal = true;

  std::vector<std::vector<Answer>> answers(contestants.size());
  for (std::uint64_t step = 1; step <= steps; ++step) {
    motion.go_to(step);
    objects.follow(motion);
    // The second one finds the objects in the caches: the order alternates.
    for (std::size_t turn = 0; turn < contestants.size(); ++turn) {
      const std::size_t i = (turn + step) % contestants.size();
      StepResult& numbers = result.managers[i].steps.emplace_back();
      numbers.update_ms = contestants[i].update();
      answers[i].clear();
      for (const Query& query : scene.queries) {
        answers[i].push_back(contestants[i].ask(query));
        numbers.queries.push_back(numbers_of(answers[i].back()));
      }
    }
    for (std::size_t q = 0; compare && result.first_difference.empty() && q < scene.queries.size(); ++q) {
      const std::string what = difference(scene.queries[q], motion, manager, answers[0][q], *compare, answers[1][q]);
      if (what.empty()) continue;
      result.answers_equal = false;
      result.first_difference = fmt::format("step {}, {}: {}", step, scene.queries[q].name, what);
    }
    std::uint64_t pairs = 0;
    for (const Answer& answer : answers[0]) pairs += answer.hits.size();
    progress(step, result.objects, pairs);
  }
  result.touched = touched_objects(scene, answers[0]);
  return result;
}

std::string fcl_version() {
  return FCL_VERSION;
}

std::string difference(const Query& query, const ObjectMotion& motion, const std::string& name_x, const Answer& x,
                       const std::string& name_y, const Answer& y) {
  if (query.kind == Kind::first)
    return x.touching == y.touching ? std::string()
                                    : fmt::format("{} finds a pair that touches, {} none", x.touching ? name_x : name_y,
                                                  x.touching ? name_y : name_x);
  if (query.kind == Kind::distance)
    return x.distance == y.distance
               ? std::string()
               : fmt::format("least distance {:.17g} on {}, {:.17g} on {}", x.distance, name_x, y.distance, name_y);
  return hits_difference(query, motion, name_x, x, name_y, y);
}

}  // namespace boxstream::query
