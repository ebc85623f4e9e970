// Furniture catalogues of Sweet Home 3D (.sh3f): zip archives of OBJ models with a list of what they are, read in
// place. Debian's package sweethome3d-furniture has five of them, with some 820 models under CC0 and CC BY.
//
// A model is turned as its catalogue says, then scaled to the width (x), height (y) and depth (z) that it gives, and
// stands with its middle over the origin: metres, y up. Its faces keep the order of the OBJ file.
//
// Errors: InputError, one line that names the archive and the entry, for a file that is no zip archive or has no
// catalogue, for a model that is not there, is cut short or is no mesh, and for entries of more than 256 MiB.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct CatalogueModel {
  std::string id;                                // as people type it: what follows the last # of the catalogue's
  std::string name, category, creator, licence;  // UTF-8; may be empty
  std::string file;                              // within the archive
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // of the file's axes into the catalogue's
  Eigen::RowVector3d size = Eigen::RowVector3d::Zero();    // width, height, depth in metres; 0 where unknown
};

class ModelArchive {
 public:
  explicit ModelArchive(std::filesystem::path path);

  const std::vector<CatalogueModel>& models() const { return models_; }  // in the catalogue's order
  const CatalogueModel& model(const std::string& id) const;
  Mesh read(const std::string& id) const;
  // The bytes of its OBJ file, as it is.
  std::string bytes(const std::string& id) const;

 private:
  std::filesystem::path path_;
  std::vector<CatalogueModel> models_;
};

}  // namespace partwise
