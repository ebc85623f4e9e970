"""Figures of Liu 2017 to stand beside ours, on the Princeton benchmark (twenty meshes a category)."""

# Table 2.3, tolerance 0.1: parts, seconds on the author's machine, and union volume over mesh volume, for these.
COLUMNS = ("HACD", "WCSeg", "CoRISE")

TABLE_2_3 = {
    # category: (parts, seconds, volume ratio)
    "human": ((12.10, 18.85, 9.85), (84.80, 677.92, 2.33), (1.23, 1.24, 1.31)),
    "cup": ((18.90, 5.50, 4.55), (372.09, 1362.30, 1.25), (2.66, 3.02, 3.15)),
    "glasses": ((6.40, 8.90, 5.53), (433.84, 416.09, 0.63), (1.69, 1.90, 1.75)),
    "airplane": ((5.20, 7.70, 7.55), (1103.85, 431.91, 1.07), (1.30, 1.25, 1.37)),
    "ant": ((13.45, 11.25, 14.50), (223.99, 413.63, 1.76), (1.11, 1.17, 1.14)),
    "chair": ((9.50, 16.35, 10.64), (297.72, 1021.50, 1.86), (1.67, 1.56, 1.45)),
    "octopus": ((14.40, 9.10, 14.45), (903.44, 599.90, 1.98), (1.23, 1.83, 1.27)),
    "table": ((6.00, 5.55, 6.05), (3385.97, 2762.60, 1.25), (1.33, 1.68, 1.42)),
    "teddy": ((6.80, 7.45, 7.05), (1548.05, 1026.30, 2.16), (1.05, 1.05, 1.07)),
    "hand": ((9.10, 9.20, 9.00), (205.92, 670.00, 1.67), (1.14, 1.16, 1.27)),
    "plier": ((5.20, 6.50, 5.89), (393.18, 368.90, 0.88), (1.30, 1.37, 1.33)),
    "fish": ((5.05, 6.25, 5.20), (2969.80, 546.04, 0.84), (1.12, 1.16, 1.18)),
    "bird": ((5.55, 11.10, 6.39), (547.89, 515.03, 0.73), (1.36, 1.26, 1.35)),
    "armadillo": ((15.30, 20.10, 14.90), (56.89, 1914.80, 5.46), (1.12, 1.12, 1.19)),
    "bust": ((9.30, 8.70, 7.80), (118.18, 2285.80, 4.50), (1.05, 1.08, 1.11)),
    "mech": ((4.45, 3.70, 3.65), (1286.43, 2587.30, 1.04), (0.87, 1.02, 1.02)),
    "bearing": ((5.47, 3.00, 1.58), (1095.92, 1188.90, 0.25), (0.95, 1.08, 1.17)),
    "vase": ((9.80, 5.65, 5.15), (1059.17, 1247.60, 1.63), (1.06, 1.10, 1.12)),
    "fourleg": ((12.95, 14.05, 12.25), (61.85, 614.97, 1.86), (1.20, 1.23, 1.25)),
}

AVERAGE = ((9.21, 9.42, 8.00), (849.95, 1086.90, 1.75), (1.29, 1.38, 1.36))

# Table 2.1 of section 2.2.4.3: Rand error against people on the Princeton benchmark, of segmentations by shape diameter and by
# continuous visibility.
TABLE_2_1_COLUMNS = ("SDF", "CVF", "CVF_avg")

TABLE_2_1 = {
    "human": (0.18, 0.16, 0.14), "cup": (0.36, 0.45, 0.23), "glasses": (0.20, 0.21, 0.19),
    "airplane": (0.09, 0.17, 0.20), "ant": (0.02, 0.04, 0.04), "chair": (0.11, 0.10, 0.07),
    "octopus": (0.05, 0.04, 0.03), "table": (0.18, 0.12, 0.09), "teddy": (0.06, 0.08, 0.07),
    "hand": (0.20, 0.17, 0.13), "plier": (0.38, 0.21, 0.22), "fish": (0.25, 0.18, 0.18),
    "bird": (0.12, 0.25, 0.18), "armadillo": (0.09, 0.11, 0.10), "bust": (0.30, 0.31, 0.30),
    "mech": (0.24, 0.21, 0.14), "bearing": (0.12, 0.14, 0.13), "vase": (0.24, 0.18, 0.18),
    "fourleg": (0.16, 0.16, 0.17),
}

TABLE_2_1_AVERAGE = (0.18, 0.17, 0.15)

# Section 2.2.3.3: the shares of the intersection tests and of the running time that the filter saves on the search in breadth, by
# vertices. The search takes about 900 s for 10k vertices, the filter 49 % less.
SIZE_CLASSES = ("under 5k", "5k to 10k", "over 10k")
FILTER_SAVES = {"under 5k": (0.72, 0.30), "5k to 10k": (0.82, 0.37), "over 10k": (0.89, 0.49)}
FILTER_SECONDS_AT_10K = 460
