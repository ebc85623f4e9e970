2
cube.g Volumetric Rotational
cube.g Volumetric Rotational
Connections
0

