1
cube.g Joint
Connections
0
