"""What the benchmarks share: running a program and its clock, meshes, people's segmentations, tables, the history of results.

Standard library only."""
