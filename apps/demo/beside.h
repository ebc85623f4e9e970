// Tables of the dissertation (G. Liu 2017) beside what our benchmarks recorded of the same.
#pragma once

#include <string>

namespace demo {

std::string parts_beside();     // Table 2.3
std::string segments_beside();  // Table 2.1
std::string motion_beside();    // Table 5.1

}  // namespace demo
