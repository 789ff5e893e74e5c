// SPDX-License-Identifier: MIT
#include "boxstream/explain/tried.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "accuracy/advice.hpp"
#include "accuracy/knob.hpp"
#include "base/words.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/interrupt.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/scene_files.hpp"
#include "formats/scene_json/json_text.hpp"

namespace boxstream::tool {
namespace {

using accuracy::Advice;
using accuracy::Row;

std::string why(const Row& row) {
  return files::printable(row.failure.empty() ? row.unsound : row.failure);
}

std::string price_text(const Advice& advice) {
  if (!advice.price) return "";
  const accuracy::Price& price = *advice.price;
  if (price.low <= 1 && price.high >= 1)
    return fmt::format(", at the same price within noise ({:.2g} to {:.2g} of it)", price.low, price.high);
  return fmt::format(", at {:.2g} of the price of the scene as it is ({:.2g} to {:.2g})", price.value, price.low,
                     price.high);
}

std::string text_of(const Advice& advice) {
  const accuracy::Sweep& sweep = advice.sweep;
  std::string out = fmt::format("tried    This scene ran for {:.3g} s with {} of {} settings.\n", sweep.seconds,
                                sweep.rows.size(), sweep.all_settings);
  if (const Row* const own = advice.own_row())
    out += fmt::format("         As it is: {}.\n", own->may_be_advised() ? "sound" : "not sound, it " + why(*own));
  if (advice.is_scene_as_it_is())
    out += "         Nothing cheaper that was tried is sound.\n";
  else if (const Row* const best = advice.best_row())
    out += fmt::format("         The cheapest sound one: {}{}.\n", best->label, price_text(advice));
  else
    out += "         None of these is sound; with more time (--budget) others are tried.\n";
  for (const Row& row : sweep.rows)
    if (!row.may_be_advised()) out += fmt::format("         Not sound: {}, {}\n", row.label, why(row));
  if (!sweep.reference.name.empty())
    out += fmt::format("         Compared with {}.\n", sweep.reference.name);
  else if (!sweep.reference.failure.empty())
    out += fmt::format("         No reference to compare with: {}.\n", files::printable(sweep.reference.failure));
  return out;
}

nlohmann::ordered_json json_of(const Advice& advice) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Row& row : advice.sweep.rows)
    rows.push_back({{"setting", row.label},
                    {"sound", row.may_be_advised()},
                    {"why_not", row.failure.empty() ? row.unsound : row.failure},
                    {"ms_per_s", row.ms.median}});
  nlohmann::ordered_json document{{"seconds", advice.sweep.seconds},
                                  {"settings", std::move(rows)},
                                  {"reference", advice.sweep.reference.name},
                                  {"as_it_is", nullptr},
                                  {"advice", nullptr},
                                  {"price", nullptr}};
  if (const Row* const own = advice.own_row()) document["as_it_is"] = own->may_be_advised();
  if (const Row* const best = advice.best_row()) document["advice"] = best->label;
  if (advice.price) document["price"] = {advice.price->value, advice.price->low, advice.price->high};
  return document;
}

}  // namespace

Tried try_settings(const std::string& scene, double seconds) try {
  const std::string file = resolve_scene(scene, SceneKind::simulation).string();
  accuracy::Request request = accuracy::advice_request(scenes::parse_json(scenes::read_text_file(file), file), file,
                                                       seconds, other_precision());
  request.stop = interrupted;
  StatusLine status;
  const InterruptCatcher catcher;
  const Advice advice = accuracy::advise(request, [&](const accuracy::Stage& stage) {
    status.run(stage.done + 1, stage.all, stage.seconds_left, stage.what);
  });
  status.clear();
  return {text_of(advice), json_of(advice)};
} catch (const accuracy::BadKnob& error) {
  throw BadInput(error.what());
}

namespace {

namespace fs = std::filesystem;

/// A folder for the length of a job.
class Folder {
 public:
  Folder() : name_((fs::temp_directory_path() / "boxstream-XXXXXX").string()) {
    if (mkdtemp(name_.data()) == nullptr) throw accuracy::BadKnob("no folder for runs in double precision: " + name_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(name_, ignored);
  }

  std::string file(const char* name) const { return name_ + "/" + name; }

 private:
  std::string name_;
};

/// As waitpid has it.
int status_of(std::string program, std::string job, std::string answer) {
  std::string command = "answer";
  char* const words[] = {program.data(), command.data(), job.data(), answer.data(), nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, program.c_str(), nullptr, nullptr, words, environ) != 0)
    throw accuracy::BadKnob(program + " does not start");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

accuracy::Elsewhere other_precision() {
  const fs::path place = executable_directory();
  for (const fs::path& folder : {place, place / ".." / "libexec" / "boxstream"}) {
    const std::string program = (folder / "boxstream-double").string();
    if (access(program.c_str(), X_OK) != 0) continue;
    return [program](const accuracy::Bytes& job) -> accuracy::Bytes {
      const Folder folder_of_job;
      const std::string asked = folder_of_job.file("job"), answer = folder_of_job.file("answer");
      std::ofstream(asked, std::ios::binary)
          .write(reinterpret_cast<const char*>(job.data()), static_cast<std::streamsize>(job.size()));
      const int status = status_of(program, asked, answer);
      // Ctrl-C goes to both programs.
      if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM)) return {};
      if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw accuracy::BadKnob("a run in double precision failed, with a complaint of its own");
      std::ifstream file(answer, std::ios::binary);
      return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    };
  }
  return nullptr;
}

}  // namespace boxstream::tool
