// The fields of a JSON object, each taken once and checked; what is left over is refused.
#pragma once

#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {

// The whole of a file. Errors: InputError when it cannot be read or is not JSON.
inline nlohmann::json read_json(const std::filesystem::path& path) {
  nlohmann::json whole = nlohmann::json::parse(read_bytes(path), nullptr, false);
  if (whole.is_discarded()) throw InputError(path.string(), "is not JSON", "check brackets, quotes and commas");
  return whole;
}

class JsonFields {
 public:
  // `place` is that of the object in the file, empty for the whole; `page` of the docs says what fields there are.
  JsonFields(std::string file, std::string place, const nlohmann::json& object, std::string page)
      : file_(std::move(file)), place_(std::move(place)), page_(std::move(page)), object_(object) {
    if (!object_.is_object()) refuse("", "is not an object", "write { ... }");
  }

  [[noreturn]] void refuse(const std::string& name, const std::string& problem, const std::string& remedy) const {
    const std::string at = place_of(name);
    throw InputError(file_, (at.empty() ? std::string("the whole") : at) + " " + problem, remedy);
  }

  std::string place_of(const std::string& name) const {
    return place_ + (place_.empty() || name.empty() ? "" : ".") + name;
  }
  bool has(const std::string& name) const { return object_.contains(name); }

  // The fields of an object within this one, which must outlive them.
  JsonFields object(const std::string& name, const nlohmann::json& value) const {
    return {file_, place_of(name), value, page_};
  }

  // Null where it is missing.
  const nlohmann::json* find(const std::string& name) {
    known_.insert(name);
    const auto found = object_.find(name);
    return found == object_.end() ? nullptr : &*found;
  }

  const nlohmann::json& need(const std::string& name) {
    const nlohmann::json* found = find(name);
    if (found == nullptr) refuse(name, "is missing", "give it");
    return *found;
  }

  double number(const std::string& name, double otherwise, double least, double most) {
    const nlohmann::json* found = find(name);
    if (found == nullptr) return otherwise;
    const double value = found->is_number() ? found->get<double>() : NAN;
    if (!(value >= least && value <= most)) {
      refuse(name, fmt::format("is not a number from {} to {}", least, most), "change it");
    }
    return value;
  }

  int whole(const std::string& name, int otherwise, int least, int most) {
    const nlohmann::json* found = find(name);
    if (found != nullptr && !found->is_number_integer()) refuse(name, "is not a whole number", "change it");
    return static_cast<int>(number(name, otherwise, least, most));
  }

  bool truth(const std::string& name, bool otherwise) {
    const nlohmann::json* found = find(name);
    if (found == nullptr) return otherwise;
    if (!found->is_boolean()) refuse(name, "is neither true nor false", "change it");
    return found->get<bool>();
  }

  std::string text(const std::string& name) {
    const nlohmann::json& found = need(name);
    if (!found.is_string() || found.get<std::string>().empty()) refuse(name, "is no text", "write it in quotes");
    return found.get<std::string>();
  }

  // A text or a list of them, of one or more.
  std::vector<std::string> texts(const std::string& name) {
    const nlohmann::json& found = need(name);
    std::vector<std::string> result;
    if (found.is_string()) return {text(name)};
    if (!found.is_array() || found.empty()) refuse(name, "is no list of texts", "write [\"...\"]");
    for (const nlohmann::json& each : found) {
      if (!each.is_string() || each.get<std::string>().empty())
        refuse(name, "holds what is no text", "write it in quotes");
      result.push_back(each.get<std::string>());
    }
    return result;
  }

  // Two whole numbers, width and height.
  std::pair<int, int> two_sizes(const std::string& name, std::pair<int, int> otherwise) {
    constexpr double most = 8192;
    const nlohmann::json* found = find(name);
    if (found == nullptr) return otherwise;
    const auto fits = [](const nlohmann::json& each) {
      return each.is_number_integer() && each.get<double>() >= 1 && each.get<double>() <= most;
    };
    if (!found->is_array() || found->size() != 2 || !fits((*found)[0]) || !fits((*found)[1])) {
      refuse(name, fmt::format("is not two whole numbers from 1 to {}", most), "write [width, height]");
    }
    return {(*found)[0].get<int>(), (*found)[1].get<int>()};
  }

  // One of a few words; `otherwise` where it is missing.
  template <typename Value>
  Value choice(const std::string& name, Value otherwise, std::initializer_list<std::pair<const char*, Value>> words) {
    if (!has(name)) return otherwise;
    const std::string word = text(name);
    std::string all;
    for (const auto& [each, value] : words) {
      if (word == each) return value;
      all += fmt::format("{}\"{}\"", all.empty() ? "" : ", ", each);
    }
    refuse(name, fmt::format("is none of {}", all), "take one of them");
  }

  void refuse_others() const {
    for (const auto& [name, value] : object_.items()) {
      if (!known_.contains(name)) refuse(name, "is not a field that is known", "see " + page_);
    }
  }

 private:
  std::string file_, place_, page_;
  const nlohmann::json& object_;
  std::set<std::string> known_;
};

}  // namespace partwise
