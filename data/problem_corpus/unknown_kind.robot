1
cube.g Floating Rotational
Connections
0
