1
cube.g Planar Rotational
Adjacencies
1
0 0
Connections
0
