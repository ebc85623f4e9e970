3
cube.g Planar Rotational
cube.g Joint
cube.g Joint
Connections
2
1 2 NonActuated
0 0 0 0 0 0  0 0 0 0  0 0 0 0 0 0
2 1 NonActuated
0 0 0 0 0 0  0 0 0 0  0 0 0 0 0 0
