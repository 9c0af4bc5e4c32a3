#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which lines of core and gui the tests run, by folder.

    cmake --preset coverage && cmake --build --preset coverage && ctest --preset coverage
    tests/long/coverage.py [--build build/coverage] [--json FILE] [--lines FILE...]

--lines tells of these sources which lines no test runs. Exit status: 0 each part reaches what it should, 1 one does
not, 2 nothing could be counted.
"""
import argparse
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LEAST = {"core": 0.9, "gui/wizard": 0.8}  # of the lines of these parts


def counted(build):
    """Of each source of core and gui: its lines, each with how often it ran."""
    with tempfile.TemporaryDirectory() as temporary:
        written = pathlib.Path(temporary) / "coverage.json"
        done = subprocess.run(
            ["gcovr", "--root", SOURCE, "--object-directory", build, "--filter", "core/", "--filter", "gui/",
             "--gcov-ignore-parse-errors", "--json", written, "-j", str(os.cpu_count()), build], capture_output=True,
            text=True, errors="replace", cwd=SOURCE)
        if done.returncode != 0 or not written.exists():
            sys.exit(f"gcovr failed: {(done.stdout + done.stderr).strip()[-2000:]}")
        files = json.loads(written.read_text())["files"]
    ran = collections.defaultdict(lambda: collections.defaultdict(int))
    for each in files:
        # Core's headers are reached through links in the build.
        name = re.sub(r"^.*include/relucent/", "core/", each["file"])
        for line in each["lines"]:
            if not line.get("gcovr/noncode"):
                ran[name][line["line_number"]] += line["count"]
    return ran


def parts_of(name):
    """core/engine/a.cpp counts for core and core/engine, gui/wizard/frame/a.cpp for gui, gui/wizard and its folder."""
    folders = pathlib.PurePosixPath(name).parent.parts
    return ["/".join(folders[:depth]) for depth in range(1, len(folders) + 1)]


def by_part(files):
    parts = collections.defaultdict(lambda: [0, 0])
    for name, lines in files.items():
        for part in parts_of(name):
            parts[part][0] += sum(1 for count in lines.values() if count)
            parts[part][1] += len(lines)
    return {part: {"run": run, "lines": lines, "share": round(run / lines, 4)}
            for part, (run, lines) in sorted(parts.items()) if lines}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build/coverage")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--lines", nargs="+", default=[])
    options = parser.parse_args()
    if shutil.which("gcovr") is None:
        print("gcovr is not installed", file=sys.stderr)
        return 2
    if next(options.build.rglob("*.gcda"), None) is None:
        print(f"no test has run in {options.build}", file=sys.stderr)
        return 2
    files = counted(options.build.resolve())
    parts = by_part(files)
    for part, counts in parts.items():
        print(f"{part:32} {counts['run']:6} of {counts['lines']:6} lines  {100 * counts['share']:5.1f} %")
    for name in options.lines:
        missed = [str(line) for line, count in sorted(files.get(name, {}).items()) if count == 0]
        print(f"{name}: {', '.join(missed) or 'each line runs'}")
    if options.json:
        options.json.write_text(json.dumps(parts, indent=1) + "\n")
    below = [part for part, least in LEAST.items() if parts.get(part, {"share": 0.0})["share"] < least]
    for part in below:
        print(f"{part}: less than {100 * LEAST[part]:.0f} % of its lines", file=sys.stderr)
    return 1 if below else 0


if __name__ == "__main__":
    sys.exit(main())
