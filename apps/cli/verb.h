// What a verb of the program is: a row of the table in verbs.h, filled in by a file of its own.
//
// A verb file defines one `const Verb`. Its `add` puts the verb's options on the command and returns what to do once
// they are parsed; that function calls the library, names its outputs through Run::outputs and fills in the report.
// Threads, seed, progress, --json, timing, exit codes and messages are the same for all verbs and live in main.cpp and
// run.h.
#pragma once

#include <CLI/App.hpp>
#include <functional>

#include "run.h"

namespace partwise::cli {

using Action = std::function<void(Run&)>;

struct Verb {
  const char* name;
  const char* summary;  // one line, in the list of verbs
  const char* details;  // a paragraph on its own help page
  const char* example;  // command lines that work as they stand
  Action (*add)(CLI::App& command);
};

}  // namespace partwise::cli
