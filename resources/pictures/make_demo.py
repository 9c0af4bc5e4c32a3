#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Paints demo.png: evening over a lake, from nothing but noise. Run once by whoever wants another picture."""
import struct
import sys
import zlib

import numpy as np
from scipy.ndimage import gaussian_filter, gaussian_filter1d

WIDTH, HEIGHT, HORIZON = 480, 360, 215
random = np.random.default_rng(1)
x, y = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))


def colour(code):
    """An sRGB code like 'ff8800' as linear light."""
    encoded = np.array([int(code[i:i + 2], 16) for i in (0, 2, 4)]) / 255
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def gradient(position, stops):
    """Colours between (place, code) stops."""
    places = [place for place, _ in stops]
    colours = np.array([colour(code) for _, code in stops])
    return np.stack([np.interp(position, places, colours[:, c]) for c in range(3)], axis=-1)


def noise(shape, scales):
    """Smooth noise over several scales, the coarse ones strongest, zero mean and unit deviation."""
    total = np.zeros(shape)
    for scale in scales:
        layer = gaussian_filter(random.standard_normal(shape), scale, mode="wrap")
        total += np.max(scale) * layer / layer.std()
    return (total - total.mean()) / total.std()


def sky():
    picture = gradient(y / HORIZON, [(0, "14306e"), (0.45, "5a6fb8"), (0.75, "f0a56b"), (1, "ffe3a0")])
    clouds = noise((HEIGHT, WIDTH), [(3, 14), (7, 40), (1.5, 6)])
    cover = np.clip(clouds - 0.3, 0, 1.4)[..., None] * np.clip(1.2 - y / HORIZON, 0, 1)[..., None]
    picture += cover * 0.5 * (colour("ff9a7a") - picture)
    away = np.hypot(x - 330, y - 168)
    picture += np.exp(-away / 45)[..., None] * colour("ffb040") * 0.9
    picture[away < 15] = colour("fff6d8")
    return picture


def ridge(base, height, scales):
    line = sum(s * gaussian_filter1d(random.standard_normal(WIDTH), s) * s ** 0.5 for s in scales)
    return base - height * (line - line.min()) / np.ptp(line)


def paint():
    picture = sky()
    for base, height, far, near, scales in [(205, 95, "8a7fae", "b79aa8", (40, 12, 4)),
                                            (212, 60, "46527e", "6a6686", (30, 9, 3)),
                                            (216, 32, "1d3a3c", "2c4a3e", (24, 4, 1.5))]:
        line = ridge(base, height, scales)
        inside = (y >= line) & (y < HORIZON)
        depth = (y - line) / np.maximum(HORIZON - line, 1)
        picture[inside] = gradient(depth, [(0, far), (1, near)])[inside]

    # The lake mirrors what is above it, shaken by waves that grow towards the shore.
    rows = np.arange(HORIZON, HEIGHT)
    waves = noise((len(rows), WIDTH), [(0.7, 5), (1.2, 11)])
    depth = (rows - HORIZON)[:, None] / (HEIGHT - HORIZON)
    source = np.clip(2 * HORIZON - rows[:, None] - 1 + waves * (1 + 14 * depth), 0, HORIZON - 1).astype(int)
    mirrored = picture[source, x[:len(rows)]]
    picture[HORIZON:] = mirrored * (0.85 - 0.4 * depth)[..., None] + colour("0a3550") * (0.1 + 0.3 * depth)[..., None]

    # A meadow with flowers before it.
    shore = ridge(352, 40, (60, 8, 2))
    meadow = y >= shore
    grass = np.clip(0.5 + 0.25 * noise((HEIGHT, WIDTH), [(4, 0.8), (9, 3)]), 0, 1)
    picture[meadow] = gradient(grass, [(0, "0f2a12"), (1, "6f9a2a")])[meadow]
    for _ in range(150):
        fx, fy = random.integers(WIDTH), random.integers(312, HEIGHT)
        if not meadow[fy, fx]:
            continue
        petals = np.hypot(x - fx, y - fy) < random.uniform(1.2, 3.2)
        picture[petals] = colour(random.choice(["e02020", "f6d21c", "d33fb0", "ffffff", "2f6fe8"]))
    return picture


def write_png(path, linear):
    clipped = np.clip(linear, 0, 1)
    encoded = np.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)
    rows = np.round(255 * encoded).astype(np.int16)
    # Each pixel less its left neighbour (PNG filter 1) packs best for smooth pictures.
    left = np.concatenate([np.zeros_like(rows[:, :1]), rows[:, :-1]], axis=1)
    filtered = ((rows - left) % 256).astype(np.uint8).reshape(HEIGHT, -1)
    packed = zlib.compress(b"".join(b"\x01" + row.tobytes() for row in filtered), 9)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"sRGB", b"\0") + chunk(b"IDAT", packed) +
                   chunk(b"IEND", b""))


write_png(sys.argv[1] if len(sys.argv) > 1 else "demo.png", paint())
