0
Connections
0
