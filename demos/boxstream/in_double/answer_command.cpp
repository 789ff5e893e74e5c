// SPDX-License-Identifier: MIT
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "accuracy/elsewhere.hpp"
#include "accuracy/knob.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/simulate/json_report.hpp"

namespace boxstream::tool {
namespace {

struct Files {
  std::string job, answer;
};

int answer(const Files& files) try {
  std::ifstream job(files.job, std::ios::binary);
  const accuracy::Bytes asked{std::istreambuf_iterator<char>(job), std::istreambuf_iterator<char>()};
  const accuracy::Bytes said =
      accuracy::answer_job(asked, [](const scenes::Scene& scene) { return document_of(scene, "boxstream"); });
  std::ofstream file(files.answer, std::ios::binary);
  file.write(reinterpret_cast<const char*>(said.data()), static_cast<std::streamsize>(said.size()));
  return file.flush() ? 0 : 1;
} catch (const accuracy::BadKnob& error) {
  throw BadInput(error.what());
}

Action set_up_answer(CommandLine& command) {
  const auto files = std::make_shared<Files>();
  add_input(command, "JOB", files->job, "What boxstream accuracy asks")->required();
  add_input(command, "ANSWER", files->answer, "Where the answer goes")->required();
  return [files] { return answer(*files); };
}

}  // namespace

extern const Command answer_command{"answer", "Do a run that boxstream accuracy asks for",
                                    "It is for the program boxstream alone.", set_up_answer};

}  // namespace boxstream::tool
