1
cube.g Planar Rotational
