// The fields of a JSON object, each taken once and checked; what is left over is refused. Internal to this room.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "partwise/base/error.h"

namespace partwise {

class JsonFields {
 public:
  // `place` is that of the object in the file, empty for the whole.
  JsonFields(std::string file, std::string place, const nlohmann::json& object)
      : file_(std::move(file)), place_(std::move(place)), object_(object) {
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

  // One of two words; `otherwise` where it is missing.
  template <typename Value>
  Value choice(const std::string& name, Value otherwise, const std::pair<const char*, Value>& a,
               const std::pair<const char*, Value>& b) {
    if (!has(name)) return otherwise;
    const std::string word = text(name);
    if (word == a.first) return a.second;
    if (word == b.first) return b.second;
    refuse(name, fmt::format("is neither \"{}\" nor \"{}\"", a.first, b.first), "take one of them");
  }

  void refuse_others() const {
    for (const auto& [name, value] : object_.items()) {
      if (!known_.contains(name)) refuse(name, "is not a field that is known", "see docs/render.md");
    }
  }

 private:
  std::string file_, place_;
  const nlohmann::json& object_;
  std::set<std::string> known_;
};

}  // namespace partwise
