2
cube.g Volumetric Rotational
cube.g Joint
Connections
0

