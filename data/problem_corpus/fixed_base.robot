1
cube.g Fixed 0 0 0 0 0 0
Connections
0
