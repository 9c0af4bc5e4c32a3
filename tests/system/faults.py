#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lets one call after the other to the system fail under relucent-cli, and looks at what is left.

    tests/system/faults.py build/release/bin build/release/lib/libfaulty_calls.so [--all | --sample 30]
        [--seed 1] [--jobs 1] [--only calibrate] [--json FILE] [--keep FOLDER]

Law: whichever call fails, a command ends with exit status 1 and one sentence, or it succeeds with all that it
succeeds with undisturbed. Afterwards the calibration opens, and what was interrupted, begun again, ends in the
bits of an undisturbed run. Exit status: 0 that holds, 1 it does not.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

LONGEST = 60  # seconds of processor time of a command that takes a fraction of one
LONGEST_ASLEEP = 1800.0
CODES = ["ENOSPC", "EIO", "EACCES", "EMFILE", "ENOMEM"]
SMALLEST_PIECE = 32768  # of memory that counts
# Bytes that zlib takes at a time: without them nothing is compressed, which libraries have been silent about.
OF_ZLIB = 65536
MANIFEST = "calibration.relucent"
OF_CLOCKS = {"created", "stored", "seconds", "times", "when"}
TINY = ["--venue", "corner", "--projector", "16x16", "--camera", "16x16", "--paths", "4", "--levels", "5",
        "--acquisition", "fast"]


def limit_time():
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def timeless(value):
    if isinstance(value, dict):
        return {key: timeless(inner) for key, inner in value.items() if key not in OF_CLOCKS}
    return [timeless(inner) for inner in value] if isinstance(value, list) else value


def content_of(path):
    if path.name == MANIFEST:
        return json.dumps(timeless(json.loads(path.read_text())))
    return hashlib.sha256(path.read_bytes()).hexdigest()


def files_in(folder):
    """Digests by name, without what an interrupted write left, and without when each thing happened."""
    return {path.relative_to(folder).as_posix(): content_of(path) for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name != "record.json"
            and not any(part.startswith(".") for part in path.relative_to(folder).parts)}


class Place:
    """A folder of a run's own: the calibration, what commands write, and room for intermediate results."""

    def __init__(self, root, base=None):
        self.root = pathlib.Path(root)
        if base is None:
            self.root.mkdir(parents=True)
        else:
            shutil.copytree(base, self.root)
        self.temporary.mkdir(exist_ok=True)
        self.out.mkdir(exist_ok=True)

    @property
    def venue(self):
        return self.root / "venue"

    @property
    def out(self):
        return self.root / "out"

    @property
    def temporary(self):
        return self.root / "tmp"

    @property
    def manifest(self):
        return self.venue / MANIFEST


class Faults:
    def __init__(self, programs, library, work, keep=None):
        self.program, self.library, self.work, self.keep = programs / "relucent-cli", library, work, keep
        self.cache = work / "cache"
        self.numbers = iter(range(10**9))

    def fresh(self, base=None):
        return Place(self.work / f"run-{next(self.numbers)}", base)

    def run(self, place, command, call=None, code="EIO", stays=False, memory=False, exactly=0):
        """Exit status (None: it did not end), standard error, and the lines of the log."""
        log = self.work / f"log-{place.root.name}"
        environment = dict(os.environ, TMPDIR=str(place.temporary), XDG_DATA_HOME=str(self.work / "data"))
        if call is not None:
            log.unlink(missing_ok=True)
            environment.update(LD_PRELOAD=str(self.library), RELUCENT_FAULT_CALL=str(call),
                               RELUCENT_FAULT_CODE=code, RELUCENT_FAULT_STAYS="1" if stays else "0",
                               RELUCENT_FAULT_LOG=str(log))
            environment.update({"RELUCENT_FAULT_BYTES": str(exactly or SMALLEST_PIECE),
                                "RELUCENT_FAULT_MOST_BYTES": str(exactly)} if memory
                               else {"RELUCENT_FAULT_FOLDER": str(place.root)})
        try:
            ended = subprocess.run([self.program, *command], env=environment, capture_output=True, text=True,
                                   errors="replace", timeout=LONGEST_ASLEEP, stdin=subprocess.DEVNULL,
                                   preexec_fn=limit_time)
            status, said = ended.returncode, ended.stderr
        except subprocess.TimeoutExpired:
            status, said = None, ""
        lines = log.read_text(errors="replace").splitlines() if log.exists() else []
        log.unlink(missing_ok=True)
        return status, said, lines

    def done(self, place, command):
        status, said, _ = self.run(place, command)
        if status != 0:
            raise RuntimeError(f"{' '.join(map(str, command))} ended with {status}: {said}")

    def calibrate(self, place):
        return ["calibrate", place.venue, *TINY, "--cache", self.cache, "--full-disk", "stop"]

    def resume(self, place):
        return ["resume", place.venue, "--cache", self.cache, "--full-disk", "stop"]

    def measure(self, place):
        return self.resume(place) if place.manifest.exists() else self.calibrate(place)

    def prepare(self):
        """What commands begin with, and what they come to undisturbed."""
        empty = self.fresh()
        whole = self.fresh()
        self.done(whole, self.calibrate(whole))
        counted = self.fresh()
        calls = self.calls_of(counted, self.calibrate(counted))
        half = self.fresh()
        self.run(half, self.calibrate(half), call=2 * calls // 3, stays=True)
        self.commands = {
            "calibrate": Command(empty, self.calibrate, self.check_measured, self.measure),
            "resume": Command(half, self.resume, self.check_measured, self.measure),
            "export": Command(whole, self.export, self.check_written),
            "report": Command(whole, self.report, self.check_written),
            "repair": Command(whole, self.repair, self.check_repaired),
            "tidy": Command(whole, self.tidy, self.check_tidied)}
        for command in self.commands.values():
            ends = []
            for _ in range(2):
                place = self.fresh(command.begin.root)
                self.done(place, command.arguments(place))
                ends.append(files_in(place.root))
                if len(ends) == 1:
                    command.sizes = {name: (place.root / name).stat().st_size for name in ends[0]}
                shutil.rmtree(place.root)
            command.expected = ends[0]
            command.of_clocks = {name for name in ends[0] if ends[0][name] != ends[1].get(name)}
            command.before = files_in(command.begin.root)

    def calls_of(self, place, command, memory=False):
        _, said, lines = self.run(place, command, call=0, memory=memory)
        if not lines:
            raise RuntimeError(f"nothing was counted: {said}")
        return int(lines[-1].split()[1])

    def export(self, place):
        return ["export", place.venue, "--transport", place.out / "transport.npz", "--inverse",
                place.out / "inverse.npz", "--maps", place.out / "maps", "--mpcdi", place.out / "venue.mpcdi",
                "--canvas", "64x48"]

    def report(self, place):
        return ["report", place.venue, "--out", place.out / "report.html", "--no-evaluate", "--bundle",
                place.out / "bundle.zip", "--cache", self.cache]

    def repair(self, place):
        return ["repair", place.venue, "--change", "painted:0.4,0.5,0.15", "--cache", self.cache]

    def tidy(self, place):
        return ["tidy", place.venue, "--keep", "results"]

    def check_measured(self, command, place, status):
        for attempt in range(2):
            if status == 0:
                break
            status, said, _ = self.run(place, command.again(place))
            if attempt == 1 or status == 0:
                break
        if status != 0:
            return f"begun again it ended with {status}: {said.strip()}"
        return command.differences(place)

    def check_opens(self, place):
        status, said, _ = self.run(place, self.resume(place))
        return "" if status == 0 else f"afterwards it cannot be opened: {said.strip()}"

    def check_written(self, command, place, status):
        now = files_in(place.root)
        for name, content in command.before.items():
            if now.get(name) != content:
                return f"{name} of the calibration has changed"
        for name, content in now.items():
            if name in command.before or name.startswith("tmp/"):
                continue
            if name not in command.expected:
                return f"it left {name}"
            if name not in command.of_clocks and content != command.expected[name]:
                return f"it left {name}, which is not as undisturbed"
        return self.check_opens(place)

    def check_repaired(self, command, place, status):
        now = files_in(place.root)
        if now != command.before and command.differences(place):
            for name, content in command.before.items():
                if "results/" in name and now.get(name) != content:
                    return f"{name} is not as it was measured"
            if now[f"venue/{MANIFEST}"] not in (command.before[f"venue/{MANIFEST}"],
                                                command.expected[f"venue/{MANIFEST}"]):
                return "the manifest is neither that of before nor that of the repaired one"
        if wrong := self.check_opens(place):
            return wrong
        if content_of(place.manifest) == command.before[f"venue/{MANIFEST}"]:
            status, said, _ = self.run(place, self.repair(place))
            if status != 0:
                return f"begun again it ended with {status}: {said.strip()}"
        if content_of(place.manifest) != command.expected[f"venue/{MANIFEST}"]:
            return "repaired at last, the manifest is not as undisturbed"
        return ""

    def check_tidied(self, command, place, status):
        if wrong := self.check_opens(place):
            return wrong
        status, said, _ = self.run(place, self.tidy(place))
        if status != 0:
            return f"begun again it ended with {status}: {said.strip()}"
        return command.differences(place)

    def finding_of(self, name, call, code, stays, memory, exactly=0):
        """What a command whose call fails does wrong, empty: nothing; and which call it was."""
        command = self.commands[name]
        place = self.fresh(command.begin.root)
        status, said, lines = self.run(place, command.arguments(place), call, code, stays, memory, exactly)
        which = next((line for line in lines if not line.startswith("calls ")), "no call")
        finding = ended_badly(status, said)
        if not finding and status == 0 and which != "no call":
            finding = command.differences(place)
            finding = finding and f"it succeeds, but {finding}"
        finding = finding or command.check(command, place, status)
        if finding and self.keep:
            shutil.copytree(place.root, self.keep / place.root.name, dirs_exist_ok=True)
        shutil.rmtree(place.root)
        return finding, which.replace(str(place.root), "..."), said.strip()


class Command:
    def __init__(self, begin, arguments, check, again=None):
        self.begin, self.arguments, self.check, self.again = begin, arguments, check, again
        self.expected, self.of_clocks, self.before, self.sizes = {}, set(), {}, {}

    def differences(self, place):
        """Empty: everything is there, as undisturbed."""
        now = files_in(place.root)
        for name, content in self.expected.items():
            if name.startswith("tmp/"):
                continue
            if name not in now:
                return f"{name} is missing"
            if name in self.of_clocks:
                size = (place.root / name).stat().st_size
                if abs(size - self.sizes[name]) > 0.2 * self.sizes[name]:
                    return f"{name} has {size} bytes instead of about {self.sizes[name]}"
            elif now[name] != content:
                return f"{name} is not as undisturbed"
        return ""


def ended_badly(status, said):
    if status is None or status in (-signal.SIGXCPU, -signal.SIGKILL):
        return "it hangs"
    if status < 0:
        return f"it dies of signal {-status}: {said.strip()[-300:]}"
    if status not in (0, 1):
        return f"it ends with {status}: {said.strip()[-300:]}"
    sentences = [line for line in said.splitlines() if line.startswith("relucent-cli: ")]
    if status == 1 and (len(sentences) != 1 or "should not have happened" in said or "terminate" in said):
        return f"it ends without one sentence: {said.strip()[-300:]}"
    return ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("--all", action="store_true", help="every call of every command, with every code")
    parser.add_argument("--sample", type=int, default=24, help="so many calls of all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", action="append", help="this command")
    parser.add_argument("--minutes", type=float, default=1e9, help="begin nothing after that")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for what is left of findings")
    options = parser.parse_args()
    began = time.monotonic()
    memory_folder = pathlib.Path("/dev/shm")
    parent = memory_folder if os.access(memory_folder, os.W_OK) else None
    with tempfile.TemporaryDirectory(prefix="relucent-faults-", dir=parent) as temporary:
        faults = Faults(options.programs.resolve(), options.library.resolve(), pathlib.Path(temporary), options.keep)
        faults.prepare()
        chance = random.Random(options.seed)
        places = []
        counts = {}
        for name, command in faults.commands.items():
            if options.only and name not in options.only:
                continue
            for memory in (False, True):
                place = faults.fresh(command.begin.root)
                calls = faults.calls_of(place, command.arguments(place), memory)
                shutil.rmtree(place.root)
                counts[name, memory] = calls
                for call in range(1, calls + 1):
                    codes = ["ENOMEM"] if memory else CODES if options.all else [chance.choice(CODES)]
                    places += [(name, call, code, chance.random() < 0.3, memory) for code in codes]
        if options.all:
            chance.shuffle(places)  # whatever time there is for
        else:
            # Each command as often as another, however many calls it has.
            groups = [[one for one in places if (one[0], one[4]) == key] for key in counts]
            for group in groups:
                chance.shuffle(group)
            places = [one for row in zip(*[group * (1 + options.sample // max(1, len(group))) for group in groups
                                           if group]) for one in row][:options.sample]
        places += [(name, 1, "ENOMEM", True, True, OF_ZLIB) for name in faults.commands
                   if not options.only or name in options.only]
        tried, findings = {}, []

        def attempt(one):
            if time.monotonic() - began > 60 * options.minutes:
                return None
            return one, faults.finding_of(*one)

        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for result in pool.map(attempt, places):
                if result is None:
                    continue
                (name, call, code, stays, memory, *_), (finding, which, said) = result
                key = f"{name}, {'memory' if memory else 'files'}"
                tried[key] = tried.get(key, 0) + 1
                if finding:
                    findings.append({"command": name, "call": call, "code": code, "stays": stays, "memory": memory,
                                     "which": which, "finding": finding, "said": said[-400:]})
                    print(f"{name}, call {call} ({which}{', and all after it' if stays else ''}): {finding}",
                          flush=True)
    seconds = time.monotonic() - began
    for (name, memory), calls in counts.items():
        key = f"{name}, {'memory' if memory else 'files'}"
        print(f"{key:20} {calls:6} calls, {tried.get(key, 0):6} tried")
    print(f"{sum(tried.values())} faults in {seconds:.1f} s, {len(findings)} findings")
    if options.json:
        options.json.write_text(json.dumps({"what": "faults", "count": sum(tried.values()), "seconds": seconds,
                                            "found": len(findings), "findings": findings}, indent=1) + "\n")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
