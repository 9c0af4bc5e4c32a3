#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plays a film for a long time, unplugs the projector's display again and again, and says whether memory stays
flat and frames go on. Not among the tests that run by themselves: it takes as long as it is told to.

    PROJECTOR_SCREEN=256x192 tests/support/with-two-screens tests/system/soak.py build/release/bin CALIBRATION \\
        [--minutes 10] [--cycles 50] [--canvas 640x360] [--json FILE]

PROJECTOR_SCREEN: the size of the calibration's projector. Exit status: 0 flat and alive, 1 not; the figures
are printed in both cases.
"""
import argparse
import json
import os
import pathlib
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import time

WARM_UP = 0.2      # share of the time in which memory may still grow: caches, the first of everything
MOST_GROWTH = 0.02  # of resident memory from the first third of the rest to its last


def write_film(folder, width, height, frames=50):
    """Numbered pictures in which every pixel changes from each to the next."""
    line = bytes((3 * x + c * 85) % 256 for x in range(2 * width) for c in range(3))
    padding = bytes(-3 * width % 4)
    for frame in range(frames):
        rows = [line[3 * ((5 * frame + y) % width):][:3 * width] + padding for y in range(height)]
        pixels = b"".join(rows)
        header = b"BM" + struct.pack("<IHHI", 54 + len(pixels), 0, 0, 54)
        header += struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, len(pixels), 2835, 2835, 0, 0)
        (folder / f"frame{frame:03}.bmp").write_bytes(header + pixels)


def resident(pid):
    return int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def xrandr(*arguments):
    subprocess.run(["xrandr", "--output", "DUMMY1", *arguments], check=True)


def plug(size):
    listed = subprocess.run(["xrandr"], capture_output=True, text=True, check=True).stdout
    mode = f"relucent-{size}" if f"relucent-{size}" in listed else size
    xrandr("--mode", mode, "--right-of", "DUMMY0")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("calibration")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--cycles", type=int, default=50)
    parser.add_argument("--canvas", default="640x360")
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    size = os.environ.get("PROJECTOR_SCREEN", "1024x768")
    seconds = 60 * options.minutes

    with tempfile.TemporaryDirectory() as temporary:
        work = pathlib.Path(temporary)
        film = work / "film"
        film.mkdir()
        write_film(film, *map(int, options.canvas.split("x")))
        health_file = work / "log/health.json"
        show = subprocess.Popen([options.programs / "relucent", "show", options.calibration, "--content", film,
                                 "--canvas", options.canvas, "--log", work / "log"], stderr=subprocess.DEVNULL)

        def health():
            return json.loads(health_file.read_text())

        while not health_file.exists() and show.poll() is None:
            time.sleep(0.2)
        begin = time.monotonic()
        memory, cycle, lost = [], 0, 0
        while (now := time.monotonic() - begin) < seconds and show.poll() is None:
            memory.append((now, resident(show.pid)))
            state = health()
            lost += state["state"] != "playing"
            if cycle < options.cycles and now >= (cycle + 0.5) * seconds / options.cycles:
                xrandr("--off")
                time.sleep(0.5)
                plug(size)
                cycle += 1
            time.sleep(1)
        alive = show.poll() is None
        if alive:
            frames_before = health()["frames"]
            time.sleep(11)  # the health file is written every ten seconds
            alive = health()["frames"] > frames_before and all(d["shining"] for d in health()["displays"])
        last = health()
        played = time.monotonic() - begin
        log = (work / "log/show.log").read_text()
        if show.poll() is None:
            show.send_signal(signal.SIGTERM)
        ended = show.wait(30)

    settled = [value for when, value in memory if when > WARM_UP * seconds]
    third = max(1, len(settled) // 3)
    early, late = statistics.median(settled[:third]), statistics.median(settled[-third:])
    figures = {"minutes": options.minutes, "cycles": cycle, "alive": alive, "exit_status": ended,
               "failures": last["failures"], "not_playing": lost, "displays_lost": log.count("display lost"),
               "displays_back": log.count("display back"), "frames": last["frames"], "late": last["late"],
               "frames_per_second": last["frames"] / played, "frame_milliseconds": last["frame_milliseconds"],
               "resident_begin_bytes": memory[0][1], "resident_early_bytes": early,
               "resident_late_bytes": late, "growth": late / early - 1}
    print(json.dumps(figures, indent=2))
    if options.json:
        options.json.write_text(json.dumps(figures, indent=2) + "\n")
    good = (alive and ended == 0 and figures["growth"] < MOST_GROWTH and lost == 0 and
            figures["displays_back"] == cycle)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
