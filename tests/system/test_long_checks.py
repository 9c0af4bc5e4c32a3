#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""tests/long/run in a project of three sources, with programs in the place of those that take long.

    test_long_checks.py SOURCE_DIR
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]

# Finds what a source says of itself behind "// finds ", notes what it was asked for, and fails if told to.
TIDY = """#!/bin/bash
[[ $1 == --version ]] && { echo "stand-in 19"; exit; }
file=${@: -1}
echo "$file" >>"$NOTED"
[[ -z ${SLOW:-} ]] || sleep "$SLOW"
sed -n "s|// finds |$PROJECT/|p" "$file"
grep -q "// breaks" "$file" && { echo "no compiler" >&2; exit 1; }
exit 0
"""
# Each source reads what it includes by its path, as make is told.
DEPENDENCIES = """#!/bin/bash
for file in "$PROJECT"/core/*.cpp; do
  echo "$file.o: $file $(sed -n 's|#include "\\(.*\\)"|'"$PROJECT"'/\\1|p' "$file" | tr '\\n' ' ')"
done
"""


class Tidy(unittest.TestCase):
    def setUp(self):
        self.project = Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, self.project)
        for program, text in {"clang-tidy-19": TIDY, "clang-scan-deps-19": DEPENDENCIES}.items():
            self.write(f"bin/{program}", text).chmod(0o755)
        self.write("tests/long/run", (SOURCE / "tests/long/run").read_text()).chmod(0o755)
        self.write(".clang-tidy", "Checks: one\n")
        self.write("core/shared.h", "\n")
        for name in ("a", "b", "c"):
            self.write(f"core/{name}.cpp", '#include "core/shared.h"\n')
        self.write("build/tidy/compile_commands.json", json.dumps(
            [{"file": str(self.project / f"core/{name}.cpp"), "command": "c++"} for name in ("a", "b", "c")]
            + [{"file": str(self.project / "build/tidy/made.cpp"), "command": "c++"}]))

    def write(self, name, text):
        path = self.project / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", "-C", self.project, *arguments],
                       check=True, capture_output=True)

    def tidy(self, minutes=1.0, **environment):
        """Exit status, the record, the names of the sources that were looked at in their order, and what was said."""
        noted = self.project / "noted"
        noted.write_text("")
        done = subprocess.run(
            [self.project / "tests/long/run", str(minutes), "--only", "tidy", "--jobs", "1", "--json",
             self.project / "result.json"], capture_output=True, text=True,
            env=dict(os.environ, PATH=f"{self.project}/bin:{os.environ['PATH']}", PROJECT=str(self.project),
                     NOTED=str(noted), XDG_CACHE_HOME=str(self.project / "cache"), **environment))
        record, = json.loads((self.project / "result.json").read_text())
        return done.returncode, record, [Path(line).stem for line in noted.read_text().splitlines()], done

    def test_finds_nothing_in_sources_without_fault(self):
        status, record, looked_at, _ = self.tidy()
        self.assertEqual((status, record["count"], record["found"]), (0, 3, 0))
        self.assertEqual(sorted(looked_at), ["a", "b", "c"])  # not what is made

    def test_tells_what_it_finds_at_once_and_at_the_end(self):
        self.write("core/b.cpp", "// finds core/b.cpp:1:2: warning: wrong [bugprone-x]\n")
        status, record, _, done = self.tidy()
        finding = f"{self.project}/core/b.cpp:1:2: warning: wrong [bugprone-x]"
        self.assertEqual((status, record["findings"]), (1, [finding]))
        self.assertIn(finding, done.stderr)
        self.assertIn(finding, done.stdout)

    def test_leaves_out_what_is_not_of_the_project(self):
        self.write("core/b.cpp", "// finds build/tidy/protocol.h:1:2: warning: wrong [readability-x]\n")
        self.assertEqual(self.tidy()[0], 0)

    def test_an_error_is_found_wherever_it_is(self):
        self.write("core/b.cpp", "// finds build/tidy/protocol.h:1:2: error: unknown [clang-diagnostic-error]\n")
        self.assertEqual(self.tidy()[0], 1)

    def test_a_program_that_fails_is_a_finding(self):
        self.write("core/b.cpp", "// breaks\n")
        status, record, _, _ = self.tidy()
        self.assertEqual(status, 1)
        self.assertIn("no compiler", record["findings"][0])

    def test_remembers_what_was_right_until_something_that_it_reads_changes(self):
        self.tidy()
        status, record, looked_at, _ = self.tidy()
        self.assertEqual((status, record["count"], looked_at), (0, 3, []))
        self.write("core/a.cpp", "// other\n")
        self.assertEqual(self.tidy()[2], ["a"])
        self.write("core/shared.h", "// other\n")
        self.assertEqual(sorted(self.tidy()[2]), ["b", "c"])
        self.write(".clang-tidy", "Checks: two\n")
        self.assertEqual(sorted(self.tidy()[2]), ["a", "b", "c"])

    def test_does_not_remember_what_was_found(self):
        self.write("core/b.cpp", "// finds core/b.cpp:1:2: warning: wrong [bugprone-x]\n")
        self.tidy()
        status, _, looked_at, _ = self.tidy()
        self.assertEqual((status, looked_at), (1, ["b"]))

    @unittest.skipIf(shutil.which("git") is None, "git is not installed")
    def test_looks_first_at_what_was_changed_last(self):
        self.git("init")
        for name in ("c", "a", "b"):
            self.git("add", f"core/{name}.cpp")
            self.git("commit", "-m", name)
        self.assertEqual(self.tidy()[2], ["b", "a", "c"])

    def test_says_what_it_had_no_time_for(self):
        status, record, looked_at, _ = self.tidy(minutes=0.02, SLOW="5")
        self.assertEqual((status, record["found"]), (2, 0))
        self.assertIn("of 3 parts: there is no time left for them", record["missing"])
        self.assertLess(len(looked_at), 3)
        self.assertEqual(sorted(self.tidy()[2]), ["a", "b", "c"])  # what was broken off is not known

    def test_says_what_is_not_there(self):
        shutil.rmtree(self.project / "build")
        status, record, _, _ = self.tidy()
        self.assertEqual(status, 2)
        self.assertIn("is not configured", record["missing"])


if __name__ == "__main__":
    unittest.main()
