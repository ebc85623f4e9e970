// The rows of a batch that a process works on, of a batch that several may share.
//
// What is drawn by chance for a batch (samples, dropout) is drawn for all of its rows by every process, which then
// takes its own: so a batch has the same gradient, up to rounding, however many processes share it.
#pragma once

#include <cstdint>

namespace partwise {

struct Rows {
  std::int64_t first = 0, count = 0;
  std::int64_t all = 0;  // of the whole batch
};

}  // namespace partwise
