// A picture of a scene file, as bright as its object would be photographed: render SCENE.json OUT.png
#include <partwise/appearance/rendering/channel_files.h>
#include <partwise/appearance/rendering/scene_file.h>
#include <partwise/base/atomic_file.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::RenderedScene rendered = partwise::render(partwise::read_scene(argv[1]));
  const partwise::Image mask = rendered.seen.mask_image();
  partwise::write_file(argv[2], partwise::encode_tone_mapped(rendered.image, mask));
  std::cout << "the object covers " << 100 * rendered.seen.foreground() << " % of the picture\n";
}
