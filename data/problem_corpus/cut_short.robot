2
cube.g Volumetric Rotational
cube.g Joint
Connections
1
0 1 NonActuated
0 0 0 0 0 0  0 0 0 0  0 0 0 