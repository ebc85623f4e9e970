// Which files a process has read, for programs that keep account of what was made from what. Off until someone asks for
// it: a library that reads for years should not remember every name.
//
// Errors: none.
#pragma once

#include <filesystem>
#include <vector>

namespace partwise {

// From now on names are kept.
void keep_read_log();

// Told by whatever opens a file to read it; read_bytes does. From any thread.
void note_read(const std::filesystem::path& path);

// Each once, as it was named, in the order of the alphabet.
std::vector<std::filesystem::path> files_read();

}  // namespace partwise
