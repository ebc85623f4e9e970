1
cube.g Volumetric Rotational
Connections
0
