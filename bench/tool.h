// How the programs of this folder end: 0 or what `work` returns, 1 with one line when it cannot be done, 2 for wrong
// usage.
#pragma once

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

namespace partwise::bench {

template <typename Work>
int run_tool(const char* name, CLI::App& app, int argc, char** argv, const Work& work) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return work();
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 1;
  }
}

}  // namespace partwise::bench
