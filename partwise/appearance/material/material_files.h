// Fitted materials and bases in files, and those that ship in models/.
//
// A material is a JSON object: "model": "dsbrdf", "name", "log_rmse" (null where it is not known), and "red", "green",
// "blue", each a list of three lobes from broad to sharp. A lobe has "log_kappa" and "log_gamma", the first one "gamma"
// in its place: six coefficients each, in the order of dsbrdf.h. Six digits are kept.
//
// Errors: InputError for a file that cannot be read or written or says something else, and for an unknown name.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/material/dsbrdf_basis.h"
#include "partwise/appearance/material/merl.h"

namespace partwise {

struct MaterialFile {
  std::string name;
  std::optional<double> log_rmse;  // of the fit, as half_angle_table.h has it
  Dsbrdf brdf;
};

std::string encode_material(const MaterialFile& material);
MaterialFile decode_material(const std::string& file, std::string_view bytes);
void write_material(const std::filesystem::path& path, const MaterialFile& material);  // atomic
MaterialFile read_material(const std::filesystem::path& path);

void write_basis(const std::filesystem::path& path, const DsbrdfBasis& basis);
DsbrdfBasis read_basis(const std::filesystem::path& path);

// A measured material: a .binary of MERL as it stands, a Neural-BRDF network (.h5) tabulated on the same grid.
MerlTable read_measured(const std::filesystem::path& path);

// A material of any kind: a shipped one by its name, or a file, fitted (.json) or measured (.binary, .h5). Files are
// named relative to `folder`. Errors: those of reading; for an unknown name one that gives names like it.
bool is_material_file(const std::string& name);
std::shared_ptr<const Brdf> find_material(const std::string& name, const std::filesystem::path& folder = {});

// What ships in models/: fits of the hundred MERL materials, sorted by name; the twenty that experiments keep for
// tests, and the other eighty; the basis made from these.
std::vector<std::string> shipped_materials();
MaterialFile shipped_material(const std::string& name);
std::vector<std::string> test_materials();
std::vector<std::string> training_materials();
DsbrdfBasis shipped_basis();

}  // namespace partwise
