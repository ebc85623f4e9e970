// Java's .properties files: "key = value" a line, in ISO 8859-1, with \uXXXX for all other letters.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace partwise {

// Keys and values in UTF-8; of a key that stands twice the last value. Lines that are not of the form are keys without
// a value, as Java has it: nothing is an error.
std::map<std::string, std::string> read_properties(std::string_view bytes);

}  // namespace partwise
