#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What packaging/common.sh does to a system: scripted stand-ins for Debian's tools record what it asks for.

    test_packaging.py SOURCE_DIR
"""
import collections
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]

TOOLS = {
    # $STATE/installed and $STATE/offered list packages; $STATE/calls is the record.
    "dpkg-query": r"sed 's/^/ii \t/' $STATE/installed; printf 'rc \tremoved\n'",
    "apt-cache": """echo "$*" >>"$STATE/questions"
        for name in "${@:2}"; do
          grep -qxF "$name" "$STATE/offered" && candidate=1.0 || candidate="(none)"
          printf '%s:\\n  Installed: (none)\\n  Candidate: %s\\n  Version table:\\n' "$name" "$candidate"
        done""",
    "apt-get": 'echo "$*" >>"$STATE/calls"; [[ $* == *--simulate* ]] && cat "$STATE/plan"; true',
    "cmake": "true",
    "sudo": '[[ -e $STATE/sudo ]] || exit 1; [[ $1 == -n ]] && shift; exec "$@"',
}
NOBODY = 65534


class Scripted(unittest.TestCase):
    """A copy of packaging/ in a folder of its own, where nothing of the system is asked."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copytree(SOURCE / "packaging", self.folder / "packaging")
        (self.folder / "packaging/dependencies").write_text(
            "# a list\n[build]\nalpha  # why\nold-name | new-name\n\n[tests]\nbeta\n")
        for name, body in TOOLS.items():
            tool = self.folder / "tools" / name
            tool.parent.mkdir(exist_ok=True)
            tool.write_text(f"#!/bin/bash\n{body}\n")
            tool.chmod(0o755)
        self.state = self.folder / "state"
        self.state.mkdir()
        self.says(installed="", offered="alpha beta old-name new-name", calls="", plan="")

    def says(self, **files):
        for name, text in files.items():
            (self.state / name).write_text("".join(word + "\n" for word in text.split("," if name == "plan" else None)))

    def calls(self):
        return (self.state / "calls").read_text().split("\n")[:-1]


class Install(Scripted):
    def install(self, *sections, root=False, options=""):
        """installDependencies SECTIONS of a program called with OPTIONS, as root or as somebody else."""
        somebody = {}
        if os.geteuid() == 0 and not root:
            for path in [self.folder, *self.folder.rglob("*")]:
                os.chown(path, NOBODY, NOBODY)
            somebody = {"user": NOBODY, "group": NOBODY, "extra_groups": []}
        environment = {"PATH": f"{self.folder}/tools:/usr/bin:/bin", "STATE": str(self.state)}
        return subprocess.run(
            ["bash", "-c", f"set -euo pipefail; source packaging/common.sh; refuseOptions {options}; "
             f"installDependencies {' '.join(sections)}"],
            cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False,
            **somebody)

    def test_nothing_to_do_is_silent_and_asks_for_nothing(self):
        self.says(installed="alpha new-name")
        done = self.install("build")
        self.assertEqual((done.returncode, done.stdout, done.stderr, self.calls()), (0, "", "", []))

    def test_only_what_is_missing_is_installed_and_nothing_else_touched(self):
        self.says(installed="alpha old-name", sudo="")
        done = self.install("build", "tests")
        self.assertEqual(done.returncode, 0, done.stderr)
        update, plan, install = self.calls()
        self.assertEqual(update, "update")
        self.assertIn("--simulate", plan)
        self.assertRegex(install, r" beta$")
        self.assertNotIn("alpha", install)
        for guard in ["--no-remove", "--no-upgrade", "--no-install-recommends", "--yes"]:
            self.assertIn(guard, install.split())

    def test_the_alternative_that_the_release_offers_is_taken(self):
        self.says(installed="alpha", offered="alpha new-name", sudo="")
        self.assertEqual(self.install("build").returncode, 0)
        self.assertRegex(self.calls()[-1], r" new-name$")

    def test_what_was_removed_and_left_its_settings_is_missing(self):
        (self.folder / "packaging/dependencies").write_text("[build]\nremoved\n")
        self.says(offered="removed", sudo="")
        self.assertEqual(self.install("build").returncode, 0)
        self.assertRegex(self.calls()[-1], r" removed$")

    def test_the_package_lists_are_read_once_however_many_packages_there_are(self):
        names = [f"package-{i}" for i in range(40)]
        (self.folder / "packaging/dependencies").write_text("[build]\n" + "\n".join(names) + "\n")
        self.says(offered=" ".join(names), sudo="")
        self.assertEqual(self.install("build").returncode, 0)
        self.assertEqual(self.calls()[-1].split()[-40:], names)
        questions = (self.state / "questions").read_text().split("\n")[:-1]
        self.assertEqual(len(questions), 2)  # before the lists are brought up to date and after

    def test_what_a_release_may_lack_is_installed_only_where_it_is_offered(self):
        (self.folder / "packaging/dependencies").write_text("[build]\nalpha\nsplit-off ?\n")
        for offered, calls in [("alpha", 0), ("alpha split-off", 3)]:
            self.says(installed="alpha", offered=offered, sudo="", calls="")
            done = self.install("build")
            self.assertEqual((done.returncode, len(self.calls())), (0, calls), done.stderr)
        self.assertRegex(self.calls()[-1], r" split-off$")
        self.says(installed="alpha split-off", calls="")
        self.assertEqual((self.install("build").stdout, self.calls()), ("", []))

    def test_without_root_and_sudo_one_sentence_names_packages_and_command(self):
        done = self.install("build")
        self.assertEqual((done.returncode, done.stdout, self.calls()), (1, "", []))
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertRegex(done.stderr, r"missing.*apt-get install .*alpha old-name")

    def test_what_the_missing_packages_need_newer_is_named_and_brought_along(self):
        self.says(installed="old-name", sudo="", plan="Inst libc6 [2.36-9] (2.36-10 Debian),Inst alpha (1.0 Debian)")
        done = self.install("build")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"newer versions of these.*: libc6\n")
        self.assertRegex(self.calls()[-1], r"--no-upgrade --no-remove.* alpha$")

    def test_nothing_is_done_when_the_plan_fails(self):
        self.says(installed="old-name", sudo="")
        tool = self.folder / "tools/apt-get"
        tool.write_text('#!/bin/bash\necho "$*" >>"$STATE/calls"; [[ $* != *--simulate* ]]\n')
        done = self.install("build")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "cannot install alpha beside what is there")
        self.assertFalse([call for call in self.calls() if "--simulate" not in call and call != "update"])

    def test_an_option_is_refused(self):
        done = self.install("build", options="--purge")
        self.assertEqual((done.returncode, done.stdout, self.calls()), (1, "", []))
        self.assertRegex(done.stderr, "no option --purge")

    @unittest.skipUnless(os.geteuid() == 0, "needs to be root")
    def test_root_needs_no_sudo(self):
        done = self.install("build", root=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(self.calls()[-1], r" alpha old-name$")


class Run(Scripted):
    def setUp(self):
        super().setUp()
        self.says(installed="alpha new-name")
        self.program("relucent-cli", '[[ $1 == calibrate ]] && mkdir -p "$2" && touch "$2/calibration.relucent"; true')

    def program(self, name, body):
        path = self.folder / "build/release/bin" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'#!/bin/bash\necho "{name} $*" >>"$STATE/calls"\n{body}\n')
        path.chmod(0o755)

    def run_it(self, **environment):
        environment |= {"PATH": f"{self.folder}/tools:/usr/bin:/bin", "STATE": str(self.state)}
        return subprocess.run([self.folder / "packaging/run"], env=environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, check=False)

    def deeds(self):
        return [call.split()[1] for call in self.calls()]

    def test_it_rehearses_and_says_where_the_results_are(self):
        done = self.run_it()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.deeds()[0], "calibrate")
        self.assertEqual(self.deeds()[-2:], ["evaluate", "report"])
        self.assertIn(f"{self.folder}/build/rehearsal/report.html", done.stdout)

    def test_with_a_display_it_opens_the_wizard(self):
        self.program("relucent", "true")
        for display in ["DISPLAY", "WAYLAND_DISPLAY"]:
            self.says(calls="")
            self.assertEqual(self.run_it(**{display: "anything"}).returncode, 0)
            self.assertEqual([call.strip() for call in self.calls()], ["relucent"])

    def test_again_it_goes_on_from_the_calibration_that_is_there(self):
        self.run_it()
        self.says(calls="")
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.deeds()[0], "resume")

    def test_a_failure_is_passed_on(self):
        self.program("relucent-cli", "exit 1")
        self.assertEqual(self.run_it().returncode, 1)
        self.assertEqual(len(self.deeds()), 1)


class Check(Scripted):
    """packaging/test, which builds for the sanitizers behind the release build's tests."""

    def setUp(self):
        super().setUp()
        self.says(installed="alpha new-name beta")

    def tool(self, name, body):
        path = self.folder / "tools" / name
        path.write_text(f'#!/bin/bash\necho "{name} $*" >>"$STATE/calls"\n{body}\n')
        path.chmod(0o755)

    def check(self, building="true", testing="true"):
        self.tool("cmake", building)
        self.tool("ctest", testing)
        environment = {"PATH": f"{self.folder}/tools:/usr/bin:/bin", "STATE": str(self.state)}
        done = subprocess.run([self.folder / "packaging/test"], env=environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, check=False)
        tested = [call.split()[2] for call in self.calls() if call.startswith("ctest")]
        return done, tested

    def test_both_builds_are_tested(self):
        done, tested = self.check()
        self.assertEqual((done.returncode, done.stderr, tested), (0, "", ["release", "asan"]))

    def test_failures_of_one_do_not_keep_the_other_from_being_tested(self):
        done, tested = self.check(testing="[[ $* != *release* ]]")
        self.assertEqual((done.returncode, tested), (1, ["release", "asan"]))
        self.assertRegex(done.stderr, "tests failed: release")

    def test_the_sanitizers_tests_wait_for_their_build(self):
        done, tested = self.check(building="[[ $* == *asan* ]] && sleep 0.5 && touch $STATE/built; true",
                                  testing='[[ $* == *release* || -e $STATE/built ]]')
        self.assertEqual((done.returncode, tested), (0, ["release", "asan"]), done.stderr)

    def test_a_build_that_fails_is_told_and_not_tested(self):
        for preset, tested in {"release": [], "asan": ["release"]}.items():
            self.says(calls="")
            done, found = self.check(building=f'[[ $* != *"--build --preset {preset}"* ]] || {{ echo "broken here"; exit 1; }}')
            self.assertEqual((done.returncode, found), (1, tested))
            self.assertRegex(done.stderr, f"broken here[^$]*building {preset} failed")


class Materials(Scripted):
    """packaging/bill-of-materials on a system of scripted packages."""

    def setUp(self):
        super().setUp()
        (self.folder / "program").write_text("a program")
        for name, body in {
                "ldd": r'printf "\tlibalpha.so.1 => /usr/lib/libalpha.so.1 (0x1)\n\tlinux-vdso.so.1 (0x2)\n"',
                "dpkg-query": r'''case $1 in
                --search) echo "libalpha1:amd64, libalpha1:i386: /usr/lib/libalpha.so.1" ;;
                --show) printf "1:2.0+b1\namd64\nalpha\n1:2.0\nhttps://alpha.example\n" ;; esac'''}.items():
            tool = self.folder / "tools" / name
            tool.write_text(f"#!/bin/bash\n{body}\n")
            tool.chmod(0o755)

    def bill(self, *options):
        return subprocess.run(
            [sys.executable, self.folder / "packaging/bill-of-materials", "1.2.3", *options, self.folder / "program"],
            env={"PATH": f"{self.folder}/tools:/usr/bin:/bin"}, capture_output=True, text=True, check=False)

    def test_every_loaded_package_is_named_once(self):
        done = self.bill("--package", "fonts-beta")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        bill = json.loads(done.stdout)
        self.assertEqual((bill["bomFormat"], bill["metadata"]["component"]["version"]), ("CycloneDX", "1.2.3"))
        self.assertEqual([part["name"] for part in bill["components"]], ["program", "fonts-beta", "libalpha1"])
        alpha = bill["components"][-1]
        self.assertEqual(alpha["version"], "1:2.0+b1")
        self.assertRegex(alpha["purl"], r"^pkg:deb/\w+/libalpha1@1%3A2\.0%2Bb1\?arch=amd64")
        self.assertEqual(bill["components"][0]["hashes"][0]["content"], hashlib.sha256(b"a program").hexdigest())
        references = [part["bom-ref"] for part in bill["components"]]
        self.assertEqual(bill["dependencies"][0]["dependsOn"], references)
        self.assertEqual(len(set(references)), len(references))

    def test_the_same_system_gives_the_same_bytes(self):
        self.assertEqual(self.bill().stdout, self.bill().stdout)

    def test_what_is_missing_is_said(self):
        (self.folder / "program").unlink()
        done = self.bill()
        self.assertEqual(done.returncode, 1)
        self.assertIn("there is no", done.stderr)


class OnePlace(unittest.TestCase):
    def test_every_file_has_the_version_of_the_project(self):
        version = re.search(r"project\(Relucent VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        linux = SOURCE / "packaging/linux"
        self.assertRegex((linux / "changelog").read_text(), rf"^relucent \({re.escape(version)}\)")
        released = re.search(r'<release version="([^"]+)"', (linux / "org.relucent.relucent.metainfo.xml").read_text())
        self.assertEqual(released[1], version)

    def test_the_icons_are_of_the_kinds_that_they_say(self):
        icons = SOURCE / "resources/icons"
        picture = icons.joinpath("relucent.icns").read_bytes()
        self.assertEqual((picture[:4], int.from_bytes(picture[4:8], "big")), (b"icns", len(picture)))
        picture = icons.joinpath("relucent.ico").read_bytes()
        self.assertEqual(picture[:4], b"\0\0\1\0")
        for entry in range(picture[4]):
            size, place = (int.from_bytes(picture[at:at + 4], "little") for at in (6 + 16 * entry + 8, 6 + 16 * entry + 12))
            self.assertEqual(picture[place:place + 4], b"\x89PNG")
            self.assertLessEqual(place + size, len(picture))

    def test_the_menu_and_software_centres_speak_every_language(self):
        linux = SOURCE / "packaging/linux"
        menu = (linux / "org.relucent.relucent.desktop").read_text()
        files = [linux / "org.relucent.relucent.metainfo.xml", linux / "org.relucent.relucent.xml"]
        said = collections.Counter(
            (file, part.tag, part.get("{http://www.w3.org/XML/1998/namespace}lang", "en"))
            for file in files
            for part in xml.etree.ElementTree.parse(file).iter()
            if re.sub("{.*}", "", part.tag) in ("summary", "p", "li", "keyword", "comment"))
        languages = [file.stem.removeprefix("relucent_") for file in (SOURCE / "translations").glob("relucent_*.ts")]
        self.assertGreater(len(languages), 1)
        for language in languages:
            with self.subTest(language=language):
                for key in ("GenericName", "Comment", "Keywords"):
                    self.assertRegex(menu, rf"(?m)^{key}{'' if language == 'en' else re.escape(f'[{language}]')}=\S")
                for (file, part, english), count in list(said.items()):
                    if english == "en":
                        self.assertEqual(said[file, part, language], count, f"{file.name}: {part}")

    def test_what_vcpkg_is_asked_for_is_json(self):
        self.assertIn("opencv4", str(json.loads((SOURCE / "vcpkg.json").read_text())["dependencies"]))


class TheList(unittest.TestCase):
    def test_every_line_is_a_section_or_packages(self):
        package = r"[a-z0-9][a-z0-9.+-]+"
        for line in (SOURCE / "packaging/dependencies").read_text().splitlines():
            text = line.split("#")[0].strip()
            self.assertRegex(text, rf"^(|\[(build|run|tests|long|package)\]|{package}( \?|( \| {package})*))$", line)

    def test_the_scripts_parse(self):
        for script in filter(Path.is_file, (SOURCE / "packaging").rglob("*")):
            shell = re.match(r"#!/bin/(bash|sh)", script.read_text(errors="replace"))
            if shell or script.suffix == ".sh":
                checked = subprocess.run([shell[1] if shell else "bash", "-n", script], check=False)
                self.assertEqual(checked.returncode, 0, script)


if __name__ == "__main__":
    unittest.main(verbosity=1)
