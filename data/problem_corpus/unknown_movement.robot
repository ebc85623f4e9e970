1
cube.g Planar Sideways
Connections
0
