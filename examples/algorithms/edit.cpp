// The object of a photo in another material: edit PHOTO MATERIAL OUT.png
#include <partwise/appearance/material/material_files.h>
#include <partwise/base/shared_files.h>
#include <partwise/editing/edit_photo.h>
#include <partwise/imaging/png.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::EditingNetworks networks =
      partwise::read_editing_networks(partwise::shared_file("models/networks/editing.pt"));
  const partwise::Photo photo = partwise::read_photo(argv[1], {});  // the object: what is not plain background
  const partwise::PhotoLayers layers = partwise::read_layers(networks, photo, {.refine = true, .refinement = {}});
  const partwise::Image image =
      partwise::edited(photo, layers, {partwise::shipped_material(argv[2]).brdf.coefficients()});
  partwise::write_png(argv[3], image, partwise::PngCodes::plain8);  // values as they are shown
  std::cout << "rendered anew, the photo is off by " << layers.error << "; before refinement by " << layers.error_before
            << "\n";
}
