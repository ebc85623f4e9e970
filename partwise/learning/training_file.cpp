#include "partwise/learning/training_file.h"

#include "partwise/learning/training_fields.h"

namespace partwise {

std::string network_to_train(const std::filesystem::path& path) {
  const nlohmann::json whole = read_training_file(path, 0);
  return JsonFields(path.string(), "", whole, training_page).text("network");
}

}  // namespace partwise
