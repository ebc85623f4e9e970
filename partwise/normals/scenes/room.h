// Rooms that chance furnishes, for pictures of scenes whose depth and normals are known exactly: a box with furniture
// standing on its floor, and a camera in it.
//
// Metres, y up; the floor's middle is the origin. Each piece of furniture is turned about y, stands on the floor within
// the walls, and its box overlaps no other and not the camera's surroundings; what finds no place after some draws is
// left out. The camera stands near a wall at the height of a person's chest or eyes, looks past the middle of the room
// and a little down.
//
// Parts, numbered over the whole room: floor, ceiling, walls, then those of the furniture in its order. Deterministic
// in the draw. Errors: CheckFailed for settings out of range and for furniture without faces.
#pragma once

#include <vector>

#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/base/draw.h"

namespace partwise {

// Metres, y up. One part a face, 0 .. parts - 1.
struct Furniture {
  Mesh mesh;
  std::vector<int> part_of_face;
  int parts = 1;
};

struct RoomSettings {
  double least_side = 3, most_side = 6;  // of the floor
  double least_height = 2.4, most_height = 3;
  int least_pieces = 3, most_pieces = 9;
  double field_of_view = 45;  // of the picture's height, degrees; a Kinect's is 43 to 49
};

enum RoomPart { floor_part, ceiling_part, wall_part, first_furniture_part };

struct Room {
  std::vector<RenderMesh> meshes;  // the box first
  int parts = 0;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  // along x, y and z
  Camera camera;
};

Room drawn_room(const std::vector<Furniture>& furniture, Draw& draw, const RoomSettings& settings = {});

}  // namespace partwise
