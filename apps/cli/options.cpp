#include "options.h"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <cmath>

#include "partwise/base/error.h"

namespace partwise::cli {

CLI::Option* add_file(CLI::App& command, const std::string& option, std::string& file, const std::string& help) {
  const auto take = [option, &file](const std::string& name) {
    if (name.empty()) throw CLI::ValidationError(option, "the name of the file is empty");
    file = name;
  };
  return command.add_option_function<std::string>(option, take, help)->type_name("FILE");
}

CLI::Option* add_mesh(CLI::App& command, std::string& file) {
  return command.add_option("MESH", file, "The mesh: .off, .obj, .ply, .stl, .gltf or .glb")->required()->type_name("");
}

CLI::Option* add_count(CLI::App& command, const std::string& option, int& count, int least, const std::string& help) {
  const auto take = [option, least, &count](const int& number) {
    if (number < least) throw CLI::ValidationError(option, fmt::format("{} is less than {}", number, least));
    count = number;
  };
  return command.add_option_function<int>(option, take, help)->type_name("N");
}

CLI::Option* add_positive(CLI::App& command, const std::string& option, double& number, const std::string& help) {
  const auto take = [option, &number](const double& given) {
    if (!std::isfinite(given) || given <= 0) {
      throw CLI::ValidationError(option, fmt::format("{} is not a number above 0", given));
    }
    number = given;
  };
  return command.add_option_function<double>(option, take, help)->type_name("T");
}

void refuse_choice(const std::string& option, const std::string& word, const std::string& all) {
  throw CLI::ValidationError(option, fmt::format("{} is none of {}", word, all));
}

}  // namespace partwise::cli
