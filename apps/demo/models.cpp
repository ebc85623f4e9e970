#include "models.h"

#include <array>

namespace demo {

std::span<const Model> models() {
  constexpr std::string_view cc0 = "CC0", by = "CC BY 3.0";
  static constexpr std::array<Model, 12> all{{
      {"horse.ply", "Horse", "B2przemo", by, 50, true, true},
      {"dog.obj", "Dog", "Scopia", by, 40, true, true},
      {"deer.off", "Deer", "Sizzler", cc0, 60, false, true},
      {"chair.off", "Chair", "Ingoenius", cc0, 35},
      {"toy_car.glb", "Toy car", "Oldtimer", by, 40, true},
      {"rocking_horse.glb", "Rocking horse", "Sangio", cc0, 30},
      {"table.obj", "Table", "MZiemys", cc0, 30},
      {"jar.off", "Jar", "Scopia", by, 110},
      {"coffee_cup.stl", "Coffee cup", "Reduno", cc0, 35, true},
      {"scissors.obj", "Scissors", "Celticluis", cc0, 30},
      {"faucet.ply", "Garden tap", "Scopia", by, 50},
      {"teddy_bear.ply", "Teddy bear", "Manitislate", cc0, 25},
  }};
  return all;
}

}  // namespace demo
