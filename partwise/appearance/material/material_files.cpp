#include "partwise/appearance/material/material_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "partwise/appearance/material/neural_brdf.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/shared_files.h"

namespace partwise {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kChannels = {"red", "green", "blue"};
constexpr const char* kRemedy = "give a file that partwise material fit has written";

const char* curve_name(int lobe, DsbrdfCurve curve) {
  if (curve == DsbrdfCurve::kappa) return "log_kappa";
  return lobe == 0 ? "gamma" : "log_gamma";
}

// Letters to change, add or leave out to make one word of the other (Levenshtein).
std::size_t letters_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = corner + (a[i] == b[j] ? 0 : 1);
      corner = std::exchange(row[j + 1], std::min({changed, row[j] + 1, row[j + 1] + 1}));
    }
  }
  return row.back();
}

// At most four: those a third of whose letters or fewer differ, the nearest first, then those that contain the name.
std::vector<std::string> names_like(const std::string& name, std::vector<std::string> names) {
  constexpr std::size_t most = 4, least_letters = 3;
  const auto distance = [&](const std::string& other) {
    const std::size_t letters = letters_between(name, other);
    if (3 * letters <= other.size()) return letters;
    const bool contained = name.size() >= least_letters && other.find(name) != std::string::npos;
    return contained ? name.size() + other.size() : std::string::npos;
  };
  std::erase_if(names, [&](const std::string& other) { return distance(other) == std::string::npos; });
  std::ranges::stable_sort(names, {}, distance);
  names.resize(std::min(names.size(), most));
  return names;
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

std::string list(const double* values, Eigen::Index count) {
  std::string text;
  for (Eigen::Index i = 0; i < count; ++i) text += (i ? ", " : "") + number(values[i]);
  return "[" + text + "]";
}

Json parse(const std::string& file, std::string_view bytes) {
  Json json = Json::parse(bytes, nullptr, false);
  if (json.is_discarded()) throw InputError(file, "is no JSON", kRemedy);
  if (!json.is_object()) throw InputError(file, "is no JSON object", kRemedy);
  return json;
}

// Runs `read`, and tells what is missing or of another type as the file's fault.
template <typename Read>
auto decoded(const std::string& file, const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    std::string what = error.what();  // "[json.exception...] key 'red' not found"
    what = what.substr(std::min(what.find("] ") + 2, what.size()));
    throw InputError(file, fmt::format("is not as expected: {}", what.substr(0, 120)), kRemedy);
  }
}

double finite(const std::string& file, const Json& value) {
  const auto result = value.get<double>();
  if (!std::isfinite(result)) throw InputError(file, "holds a number that is not finite", kRemedy);
  return result;
}

Eigen::VectorXd numbers(const std::string& file, const Json& json, Eigen::Index count) {
  const auto& values = json.get_ref<const Json::array_t&>();
  if (static_cast<Eigen::Index>(values.size()) != count) {
    throw InputError(file, fmt::format("has a list of {} numbers where {} belong", values.size(), count), kRemedy);
  }
  Eigen::VectorXd result(count);
  for (Eigen::Index i = 0; i < count; ++i) result[i] = finite(file, values[static_cast<std::size_t>(i)]);
  return result;
}

Json read_json(const std::filesystem::path& path) { return parse(path.string(), read_bytes(path)); }

}  // namespace

std::string encode_material(const MaterialFile& material) {
  std::string text = fmt::format("{{\n \"model\": \"dsbrdf\",\n \"name\": {},\n \"log_rmse\": {}",
                                 Json(material.name).dump(-1, ' ', false, Json::error_handler_t::replace),
                                 material.log_rmse ? number(*material.log_rmse) : "null");
  for (int channel = 0; channel < 3; ++channel) {
    text += fmt::format(",\n \"{}\": [", kChannels[channel]);
    for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
      text += lobe ? ",\n  {" : "\n  {";
      for (const DsbrdfCurve curve : {DsbrdfCurve::kappa, DsbrdfCurve::gamma}) {
        const double* values =
            material.brdf.coefficients().data() + channel * dsbrdf_channel_size + curve_offset(lobe, curve);
        text += fmt::format("{}\"{}\": {}", curve == DsbrdfCurve::kappa ? "" : ", ", curve_name(lobe, curve),
                            list(values, spline_size));
      }
      text += "}";
    }
    text += "]";
  }
  return text + "\n}\n";
}

MaterialFile decode_material(const std::string& file, std::string_view bytes) {
  const Json json = parse(file, bytes);
  return decoded(file, [&] {
    if (json.at("model") != "dsbrdf") throw InputError(file, "is another model than dsbrdf", kRemedy);
    DsbrdfCoefficients coefficients;
    for (int channel = 0; channel < 3; ++channel) {
      const Json& lobes = json.at(kChannels[channel]);
      if (lobes.size() != dsbrdf_lobe_count)
        throw InputError(file, fmt::format("has {} lobes, not {}", lobes.size(), dsbrdf_lobe_count), kRemedy);
      for (int lobe = 0; lobe < dsbrdf_lobe_count; ++lobe) {
        for (const DsbrdfCurve curve : {DsbrdfCurve::kappa, DsbrdfCurve::gamma}) {
          coefficients.segment<spline_size>(channel * dsbrdf_channel_size + curve_offset(lobe, curve)) =
              numbers(file, lobes.at(static_cast<std::size_t>(lobe)).at(curve_name(lobe, curve)), spline_size);
        }
      }
    }
    std::optional<double> log_rmse;
    if (!json.at("log_rmse").is_null()) log_rmse = finite(file, json.at("log_rmse"));
    return MaterialFile{json.at("name").get<std::string>(), log_rmse, Dsbrdf(coefficients)};
  });
}

void write_material(const std::filesystem::path& path, const MaterialFile& material) {
  write_file(path, encode_material(material));
}

MaterialFile read_material(const std::filesystem::path& path) {
  return decode_material(path.string(), read_bytes(path));
}

void write_basis(const std::filesystem::path& path, const DsbrdfBasis& basis) {
  std::string text = "{\n \"model\": \"dsbrdf basis\",\n \"mean\": " + list(basis.mean.data(), dsbrdf_size);
  const Eigen::Matrix<double, dsbrdf_size, Eigen::Dynamic> projection = basis.projection.transpose();
  for (const auto& [name, columns] :
       {std::pair("components", &basis.components), std::pair("projection", &projection)}) {
    text += fmt::format(",\n \"{}\": [", name);
    for (Eigen::Index j = 0; j < columns->cols(); ++j) {
      text += (j ? ",\n  " : "\n  ") + list(columns->col(j).data(), dsbrdf_size);
    }
    text += "]";
  }
  write_file(path, text + "\n}\n");
}

DsbrdfBasis read_basis(const std::filesystem::path& path) {
  const std::string file = path.string();
  const Json json = read_json(path);
  return decoded(file, [&] {
    if (json.at("model") != "dsbrdf basis") throw InputError(file, "is no basis of materials", kRemedy);
    const Json &components = json.at("components"), &projection = json.at("projection");
    if (components.empty() || components.size() != projection.size())
      throw InputError(file, "has components without projections", kRemedy);
    DsbrdfBasis basis;
    basis.mean = numbers(file, json.at("mean"), dsbrdf_size);
    const auto count = static_cast<Eigen::Index>(components.size());
    basis.components.resize(dsbrdf_size, count);
    basis.projection.resize(count, dsbrdf_size);
    for (Eigen::Index j = 0; j < count; ++j) {
      basis.components.col(j) = numbers(file, components.at(static_cast<std::size_t>(j)), dsbrdf_size);
      basis.projection.row(j) = numbers(file, projection.at(static_cast<std::size_t>(j)), dsbrdf_size).transpose();
    }
    return basis;
  });
}

MerlTable read_measured(const std::filesystem::path& path) {
  if (path.extension() == ".h5") return tabulate(read_neural_brdf(path));
  if (path.extension() == ".binary") return read_merl(path);
  throw InputError(path.string(), "has neither of the endings .binary and .h5",
                   "give a MERL table or a Neural-BRDF network");
}

std::vector<std::string> shipped_materials() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(shared_file("models/materials"))) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

MaterialFile shipped_material(const std::string& name) {
  const std::vector<std::string> names = shipped_materials();
  if (!std::ranges::binary_search(names, name)) {
    const std::vector<std::string> like = names_like(name, names);
    throw InputError(fmt::format("material '{}'", name), "is none of those that ship",
                     fmt::format("{}partwise material list names all",
                                 like.empty() ? "" : fmt::format("did you mean {}? ", fmt::join(like, ", "))));
  }
  return read_material(shared_file(std::filesystem::path("models/materials") / (name + ".json")));
}

bool is_material_file(const std::string& name) {
  const std::filesystem::path ending = std::filesystem::path(name).extension();
  return ending == ".json" || ending == ".binary" || ending == ".h5";
}

std::shared_ptr<const Brdf> find_material(const std::string& name, const std::filesystem::path& folder) {
  if (!is_material_file(name)) return std::make_shared<Dsbrdf>(shipped_material(name).brdf);
  const std::filesystem::path path = folder / name;
  if (path.extension() == ".json") return std::make_shared<Dsbrdf>(read_material(path).brdf);
  return std::make_shared<MerlTable>(read_measured(path));
}

std::vector<std::string> test_materials() {
  const std::filesystem::path path = shared_file("models/material_split.json");
  const Json json = read_json(path);
  return decoded(path.string(), [&] { return json.at("test").get<std::vector<std::string>>(); });
}

std::vector<std::string> training_materials() {
  const std::vector<std::string> test = test_materials();
  std::vector<std::string> others;
  for (const std::string& name : shipped_materials())
    if (std::ranges::find(test, name) == test.end()) others.push_back(name);
  return others;
}

DsbrdfBasis shipped_basis() { return read_basis(shared_file("models/material_basis.json")); }

}  // namespace partwise
