// The direction of the surface at every pixel of an object on a photo: normals PHOTO OUT.exr
#include <partwise/base/shared_files.h>
#include <partwise/normals/prediction/photo_normals.h>
#include <partwise/normals/truth/normal_files.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::NormalPredictor network =
      partwise::read_normal_predictor(partwise::shared_file("models/networks/objects.pt"));
  const partwise::Image normals = partwise::photo_normals(network, partwise::read_photo(argv[1], {}));
  partwise::write_normals(argv[2], normals);
  std::cout << normals.width << " x " << normals.height << " normals\n";
}
