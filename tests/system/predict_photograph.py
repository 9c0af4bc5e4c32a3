# SPDX-License-Identifier: MIT
"""Does T p + e, with T opened by SciPy, predict photographs that the calibration never saw?

usage: predict_photograph.py T.npz COMMAND-VENUE FOLDER WIDTH HEIGHT
"""
import struct
import subprocess
import sys
import zlib

import numpy
import scipy.sparse

PATTERNS = 4
REPEATS = 8
SECONDS = 0.02


def write_png(path, pixels):
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def photographs(venue, folder, pixels, name):
    """REPEATS photographs of one pattern, camera signal per second: repeats x values."""
    image = folder + "/fresh.png"
    write_png(image, pixels)
    subprocess.run([venue, "show", folder, image], check=True)
    frames = []
    for repeat in range(REPEATS):
        output = f"{folder}/fresh.f32"
        subprocess.run([venue, "photograph", folder, str(SECONDS), output, f"fresh-{name}-{repeat}"], check=True)
        frames.append(numpy.fromfile(output, dtype="<f4") / SECONDS)
    return numpy.array(frames, dtype=float)


def main():
    path, venue, folder, width, height = sys.argv[1:6]
    width, height = int(width), int(height)
    transport = scipy.sparse.load_npz(path)
    random = numpy.random.default_rng(1)
    black = photographs(venue, folder, numpy.zeros((height, width, 3), numpy.uint8), "black").mean(axis=0)
    worst = 0.0
    for number in range(PATTERNS):
        # Full drive or none: the same light whatever the projector's response.
        pixels = (random.integers(0, 2, (height, width, 3)) * 255).astype(numpy.uint8)
        frames = photographs(venue, folder, pixels, number)
        predicted = transport @ (pixels.reshape(-1) / 255.0) + black
        seen = frames < 0.95 / SECONDS  # saturated values tell nothing
        inside = seen.all(axis=0)
        noise = frames.std(axis=0, ddof=1)[inside]
        residual = (frames[0] - predicted)[inside]
        ratio = float(numpy.sqrt((residual**2).mean() / (noise**2).mean()))
        relative = float(numpy.sqrt((residual**2).mean()) / frames.mean())
        print(f"pattern {number}: residual {ratio:.2f} times a photograph's noise, {100 * relative:.2f} % of its mean")
        worst = max(worst, ratio)
    # T was estimated from photographs as noisy as this one: at worst as much error again, sqrt(2) in all, and
    # some for the threshold.
    if worst > 1.6:
        sys.exit(f"T p + e misses a fresh photograph by {worst:.2f} times its noise")


main()
