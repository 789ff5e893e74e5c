// SPDX-License-Identifier: MIT
#include <iostream>
#include <string>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene_error.hpp"

/// Reads scenes from standard input, one a line, and writes a line for each: what the loader says against it, without
/// the name of the file, or nothing. Files that scenes name are looked up in the directory given as the argument.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: scene_verdicts DIRECTORY < SCENES\n";
    return 2;
  }
  const std::string name = std::string(argv[1]) + "/scene.json";
  for (std::string line; std::getline(std::cin, line);) {
    try {
      boxstream::scenes::parse_scene(line, name);
      std::cout << '\n';
    } catch (const boxstream::scenes::SceneError& error) {
      std::cout << std::string(error.what()).substr(name.size() + 2) << '\n';
    }
  }
}
