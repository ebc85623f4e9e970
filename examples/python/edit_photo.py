#!/usr/bin/python3
"""The object of a photo in gold paint under another light: edit_photo.py PHOTO.png EDITED.png"""

import sys

import numpy as np
import partwise as pw

edit = pw.edit(sys.argv[1], "gold-metallic-paint", light="venice")
pw.write_image(sys.argv[2], edit.image, shown=True)
found = pw.Material(edit.materials[0], "found in the photo")
above = found.evaluate(to_light=[0, 0, 1], to_viewer=[0, 0, 1])
print(f"rendered anew it differs from the photo by {edit.l2_reconstruction:.0f} (mean squared, 0 to 255)")
print(f"seen from the lamp the object sends back {np.round(above, 2)} 1/sr; most light comes from "
      f"row {edit.light.sum(axis=(1, 2)).argmax()} of 64")
