2
cube.g Volumetric Rotational
cube.g Joint
Connections
1
0 1 Revolute -1:1
0 0 0 0 0 0  0 0 0 0  0 0 0 0 0 0
