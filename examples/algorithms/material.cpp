// What a shipped material reflects straight back, and at a grazing angle: material NAME
#include <partwise/appearance/material/material_files.h>

#include <cmath>
#include <iostream>

int main(int, char** argv) {
  const partwise::Dsbrdf brdf = partwise::shipped_material(argv[1]).brdf;
  const Eigen::Vector3f up(0, 0, 1), low(std::sin(1.4f), 0, std::cos(1.4f)), across(-low.x(), 0, low.z());
  std::cout << "straight back " << brdf(up, up).transpose() << "\n"  // red, green and blue, per steradian
            << "grazing mirror direction " << brdf(low, across).transpose() << "\n";
}
