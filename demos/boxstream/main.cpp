// SPDX-License-Identifier: MIT
#include <exception>
#include <new>

#include "base/output_file.hpp"
#include "base/read_file.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/run.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace {

namespace tool = boxstream::tool;

constexpr int exit_failure = 1;
constexpr int exit_bad_input = 2;

int complain(const char* reason, int code) {
  tool::complain(reason);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  boxstream::files::remove_parts_on_signals();
  try {
    return tool::run(argc, argv);
  } catch (const tool::BadInput& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const boxstream::files::BadFile& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const boxstream::scenes::SceneError& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", exit_failure);
  } catch (const std::exception& error) {
    return complain(error.what(), exit_failure);
  }
}
