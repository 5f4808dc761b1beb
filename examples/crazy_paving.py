"""Draws the picture of crazy_paving.toml: 240 x 80 pixels of 0.5 mm, white stones with black joints of about 2 mm.

    python3 crazy_paving.py crazy_paving.png
"""
import struct
import sys
import zlib

import numpy as np

columns, rows, joint = 240, 80, 4.0
places = np.random.default_rng(4).uniform((0, 0), (columns, rows), (28, 2))
x, y = np.meshgrid(np.arange(columns) + 0.5, np.arange(rows) + 0.5)
distances = np.sort(np.hypot(x[..., None] - places[:, 0], y[..., None] - places[:, 1]), axis=-1)
levels = np.where(distances[..., 1] - distances[..., 0] > joint, 255, 0).astype(np.uint8)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


with open(sys.argv[1], "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 0, 0, 0, 0))
               + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row.tobytes() for row in levels), 9)) + chunk(b"IEND", b""))
