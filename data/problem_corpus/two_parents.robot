2
cube.g Volumetric Rotational
cube.g Joint
Connections
2
0 1 NonActuated
0 0 0 0 0 0  0 0 0 0  0 0 0 0 0 0
0 1 NonActuated
0 0 0 0 0 0  0 0 0 0  0 0 0 0 0 0
