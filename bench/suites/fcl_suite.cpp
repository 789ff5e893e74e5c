// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>

#include "inputs/batches.hpp"
#include "suites/batch_contest.hpp"
#include "suites/fcl_contest.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

const FclWork* find_work(const std::string& case_name) {
  const std::size_t colon = case_name.find(':');
  if (colon == std::string::npos || !is_batch(case_name.substr(0, colon))) return nullptr;
  for (const FclWork& work : fcl_works())
    if (work.name == std::string_view(case_name).substr(colon + 1)) return &work;
  return nullptr;
}

std::vector<FclManagerKind> choose_kinds(const Options& options) {
  std::vector<FclManagerKind> kinds = fcl_manager_kinds();
  std::string known;
  for (const FclManagerKind& kind : kinds) known += ' ' + kind.name;
  for (const std::string& name : options.peers)
    if (std::none_of(kinds.begin() + 1, kinds.end(), [&](const FclManagerKind& kind) { return kind.name == name; }))
      throw std::invalid_argument("no peer '" + name + "' in suite fcl; there are" + known);
  std::erase_if(kinds,
                [&](const FclManagerKind& kind) { return kind.name != "ours" && !options.wants_peer(kind.name); });
  return kinds;
}

}  // namespace

std::vector<CaseText> fcl_case_texts() {
  return texts_of(fcl_works());
}

bool is_fcl_case(const std::string& name) {
  return find_work(name) != nullptr;
}

void run_fcl_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> cases = options.cases;
  if (cases.empty())
    for (const FclWork& work : fcl_works()) cases.push_back("U:" + std::string(work.name));
  const std::vector<FclManagerKind> kinds = choose_kinds(options);
  FclContest contest(options, kinds, report, progress);
  for (const std::size_t n : options.sizes_or({32, 1000}, {32, 1000, 4000, 100000}))
    for (const std::string& name : cases) contest.run(name.substr(0, name.find(':')), *find_work(name), n);
}

}  // namespace boxstream::bench
