#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks the code in small ways and tells which breaks no test notices. Nothing in the source or the build is
changed: the broken file is compiled beside it and linked before the library that holds the whole one.

    tests/long/mutate.py FILE... [--build build/release] [--minutes M] [--each N] [--seed 1] [--tests REGEX]
        [--json FILE]

FILE: sources of core/FOLDER; what judges is test_STEM, then the other tests of tests/core/FOLDER, then those that
--tests names. Exit status: 0 each was noticed, 1 some were not, 2 nothing could be tried.
"""
import argparse
import collections
import json
import os
import pathlib
import random
import re
import shlex
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
EQUAL = SOURCE / "tests/long/equal_mutations"
SPARE, TIMES = 20.0, 6.0  # a test that takes so much longer than before has noticed: seconds and how many times

# What becomes what; spaces, as clang-format puts them, tell operators from templates, signs and references.
SWAPS = [(" < ", " <= "), (" <= ", " < "), (" > ", " >= "), (" >= ", " > "), (" == ", " != "), (" != ", " == "),
         (" && ", " || "), (" || ", " && "), (" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "),
         (" += ", " -= "), (" -= ", " += "), (" *= ", " /= "), ("++", "--"), ("std::max(", "std::min("),
         ("std::min(", "std::max("), ("std::floor(", "std::ceil("), ("std::ceil(", "std::floor("),
         ("true", "false"), ("false", "true"), (" ? ", " ? !"), ("(!", "("), ("return !", "return "),
         ("all_of(", "any_of("), ("any_of(", "all_of("), ("begin()", "end()"), (" % ", " / ")]
LOCK = re.compile(r"^\s*(std::(scoped|unique)_lock|std::lock_guard|QMutexLocker|tbb::spin_mutex::scoped_lock)\b.*;$")
NUMBER = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?(?:e-?\d+)?)(?![\w.])")
STATEMENT = re.compile(r"^\s+(?!return\b|throw\b|const\b|auto\b|using\b|case\b|break\b|default\b)"
                       r"[\w:.\[\]*>-]+( [+*/-]?= |\().*;$")
QUIET = re.compile(r"^\s*(#|//|/\*|\*|static_assert|namespace|using |require\(|template)")

Mutation = collections.namedtuple("Mutation", "line what text")


def without_words(line):
    """The code of a line: what stands in quotes or after // is blanked, each character for itself."""
    line = re.sub(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'', lambda found: " " * len(found.group()), line)
    return re.sub(r"//.*", lambda found: " " * len(found.group()), line)


def mutations_of(lines):
    found = []
    for number, line in enumerate(lines):
        if QUIET.match(line):
            continue
        code = without_words(line)

        def put(begin, old, new):
            found.append(Mutation(number, f"{old.strip()} -> {new.strip()}", line[:begin] + new + line[begin + len(old):]))

        for old, new in SWAPS:
            begin = code.find(old)
            while begin >= 0:
                is_word = old[0].isalpha() and begin > 0 and (code[begin - 1].isalnum() or code[begin - 1] in "_.>")
                if not is_word or old.startswith("begin"):
                    put(begin, old, new)
                begin = code.find(old, begin + len(old))
        for number_found in NUMBER.finditer(code):
            value = number_found.group(1)
            put(number_found.start(), value, "1" if value == "0" else f"{value} * 2" if value != "1" else "2")
        if LOCK.match(line) or (STATEMENT.match(code) and line.count("(") == line.count(")")):
            found.append(Mutation(number, f"without {line.strip()}", ""))
    return found


def commands_of(build, target):
    done = subprocess.run(["ninja", "-C", str(build), "-t", "commands", target], capture_output=True, text=True)
    return [line for line in done.stdout.splitlines() if not line.startswith("ninja: ")]


class CannotTry(Exception):
    """Of a file: why nothing can be said of it."""


class Judge:
    """Compiles a file of core/FOLDER in its library's way, and links and runs the tests with it."""

    def __init__(self, build, file, more, temporary):
        self.build, self.file, self.temporary = build, file.resolve(), temporary
        folder = self.file.parent
        self.compile = self.compilation(folder)
        own = SOURCE / "tests" / folder.relative_to(SOURCE)
        listed = json.loads(subprocess.run(["ctest", "--test-dir", str(build), "--show-only=json-v1"],
                                           capture_output=True, text=True, check=True).stdout)["tests"]
        chosen = [test for test in listed if (own / f"{test['name']}.cpp").exists()
                  or (more and re.search(more, test["name"]))]
        chosen.sort(key=lambda test: (test["name"] != f"test_{self.file.stem}",
                                      not (own / f"{test['name']}.cpp").exists()))
        self.tests = [(test, commands_of(build, f"bin/{test['name']}")[-1], 0.0) for test in chosen
                      if (build / "bin" / test["name"]).exists()]

    def compilation(self, folder):
        """How the library compiles: the command of one of its objects, for another source."""
        objects = self.build / folder.relative_to(SOURCE) / "CMakeFiles"
        for unity in sorted(objects.glob("*.dir/Unity/unity_*_cxx.cxx")):
            if f'"{self.file}"' in unity.read_text():
                target = str(unity.relative_to(self.build)) + ".o"
                words = shlex.split(commands_of(self.build, target)[-1])
                break
        else:
            name = f"{self.file.name}.o"
            found = [path for path in objects.glob(f"*.dir/{name}")]
            if not found:
                raise CannotTry(f"it is compiled nowhere in {self.build}")
            words = shlex.split(commands_of(self.build, str(found[0].relative_to(self.build)))[-1])
        for option in ("-MF", "-MT", "-o", "-c"):
            at = words.index(option)
            del words[at:at + 2]
        return [word for word in words if word not in ("-MD", "-Werror")]

    def compiled(self, lines):
        source = self.temporary / self.file.name
        source.write_text("\n".join(lines) + "\n")
        target = self.temporary / "broken.o"
        done = subprocess.run(self.compile + [f"-I{self.file.parent}", "-w", "-o", str(target), "-c", str(source)],
                              cwd=self.build, capture_output=True, text=True)
        return target if done.returncode == 0 else None

    def run(self, test, link, whole, limit):
        name = test["name"]
        program = self.temporary / name
        # The file's first, so that the library's is not asked for; parts of it come along with its neighbours.
        linking = link.replace(f"-o bin/{name} ", f"-o {program} {whole} -Wl,--allow-multiple-definition ", 1)
        if linking == link or subprocess.run(linking, shell=True, cwd=self.build, capture_output=True).returncode:
            raise CannotTry(f"{name} cannot be linked with it")
        environment, folder = dict(os.environ), self.build
        for each in test.get("properties", []):
            if each["name"] == "ENVIRONMENT":
                environment.update(pair.split("=", 1) for pair in each["value"])
            if each["name"] == "WORKING_DIRECTORY":
                folder = each["value"]
        command = [str(program) if pathlib.Path(word) == self.build / "bin" / name else word
                   for word in test["command"]]
        began = time.monotonic()
        child = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, start_new_session=True)
        try:
            child.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, 9)
            child.communicate()
            return False, limit
        return child.returncode == 0, time.monotonic() - began

    def prepare(self, lines):
        """With the whole file: what the tests come to, and how long they take."""
        whole = self.compiled(lines)
        if whole is None:
            raise CannotTry("it does not compile by itself")
        if not self.tests:
            raise CannotTry("no test that is built is of its folder")
        timed = []
        for test, link, _ in self.tests:
            passed, seconds = self.run(test, link, whole, None)
            if passed:
                timed.append((test, link, seconds))
            else:
                print(f"  {test['name']} fails by itself and judges nothing", flush=True)
        # The file's own first, then the quick ones.
        self.tests = sorted(timed, key=lambda one: (one[0]["name"] != f"test_{self.file.stem}", one[2]))

    def noticed(self, lines):
        """By which test; "compiler"; None: by nobody."""
        broken = self.compiled(lines)
        if broken is None:
            return "compiler"
        for test, link, seconds in self.tests:
            if not self.run(test, link, broken, SPARE + TIMES * seconds)[0]:
                return test["name"]
        return None


def known_equal():
    """Breaks that change nothing that anybody could notice: FILE, the line, what became what, and why."""
    if not EQUAL.exists():
        return set()
    entries = [line.split("\t") for line in EQUAL.read_text().splitlines() if line and line[0] != "#"]
    return {tuple(entry[:3]) for entry in entries}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build/release")
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--each", type=int, default=10**9, help="how many of a file, chosen by the seed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tests", help="further tests that judge, by a regular expression")
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    options.build = options.build.resolve()
    chance, end, equal = random.Random(options.seed), time.monotonic() + 60 * options.minutes, known_equal()
    began, tried, missed = time.monotonic(), 0, []
    for number, file in enumerate(options.files):
        path = file.resolve().relative_to(SOURCE)
        lines = (SOURCE / path).read_text().splitlines()
        wanted = [one for one in mutations_of(lines) if (str(path), lines[one.line].strip(), one.what) not in equal]
        wanted = sorted(chance.sample(wanted, min(options.each, len(wanted))))
        share = time.monotonic() + (end - time.monotonic()) / (len(options.files) - number)
        with tempfile.TemporaryDirectory() as temporary:
            try:
                judge = Judge(options.build, SOURCE / path, options.tests, pathlib.Path(temporary))
                judge.prepare(lines)
            except CannotTry as why:
                print(f"{path}: not tried: {why}", flush=True)
                continue
            counts = collections.Counter()
            for one in chance.sample(wanted, len(wanted)):
                if time.monotonic() > share:
                    break
                by = judge.noticed(lines[:one.line] + [one.text] + lines[one.line + 1:])
                counts[by] += 1
                if by is None:
                    missed.append({"file": str(path), "line": one.line + 1, "what": one.what,
                                   "code": lines[one.line].strip()})
                    print(f"  not noticed: {path}:{one.line + 1}: {one.what}: {lines[one.line].strip()}", flush=True)
        compiled = sum(counts.values()) - counts["compiler"]
        tried += compiled
        print(f"{path}: {compiled} of {len(wanted)} tried, {counts[None]} not noticed; noticed by "
              + ", ".join(f"{by} {count}" for by, count in counts.most_common() if by not in (None, "compiler")),
              flush=True)
    if options.json:
        options.json.write_text(json.dumps({"count": tried, "seconds": round(time.monotonic() - began, 1),
                                            "findings": missed}, indent=1) + "\n")
    return 2 if tried == 0 else 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
