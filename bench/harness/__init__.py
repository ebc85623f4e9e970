"""What the benchmarks share: running a program and its clock, meshes, Rand error, tables, the history of results.

Standard library only."""
