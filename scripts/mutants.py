#!/usr/bin/env python3
"""Breaks Pliant in many small ways, one at a time, and checks that the tests notice each.

  scripts/mutants.py                    all mutants of tests/mutants; exit code 1 if any survives
  scripts/mutants.py --list             lists them
  scripts/mutants.py --only cpu 'laws.*sign*'   some of them
  scripts/mutants.py --resume           skips those that are known to be killed, unless they, their file or their
                                        killers have changed
  scripts/mutants.py --named-only       does not try all quick tests on those that survive their own killers

A mutant is a table in tests/mutants/FLOOR.toml:

  file     the file that it changes, and `old`, a text in it, which must occur once; else `which` is the number of the
           occurrence, or `within` a longer text that occurs once and contains it
  new      the replacement: whole statements, or a whole expression; else `switch` is a text with
           MUTANT in place of the mutant: "MUTANT ? broken : right"
  breaks   what is then wrong
  killers  tests that should notice, the cheapest first: patterns of GoogleTest names (Suite.Name; a suite alone
           means all its tests), or names of CTest

It works in a copy, build/mutants. All C++ mutants are in one build: each is a branch that the environment variable
PLIANT_MUTANT selects. In texts that are compiled into shaders, too, the shaders are not mutated, so tests on Vulkan
would not notice; tests of these mutants run without Vulkan, and tests that fail for lack of it are skipped. Mutants of
shaders, and of texts other than code, are built one by one. A killer must pass without the mutant; one that hangs
counts as failed. A mutant that survives its killers is built separately, and one of all quick tests must fail on it.
"""
import argparse
import concurrent.futures
import fnmatch
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "mutants"
SOURCE, BUILD, RESULTS = WORK / "source", WORK / "build", WORK / "results.json"
CODE = (".cpp", ".hpp", ".inl", ".law.glsl", ".kernel.glsl")  # can be branches of one program
SHARED = ("src/laws/", "src/kernels/")  # also compiled into shaders
OPTIONS = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG -w",
           "-DPLIANT_WARNINGS_AS_ERRORS=OFF", "-DPLIANT_JOINED=OFF"]
LEAST_TIMEOUT, TIMES_LONGER = 120, 20  # s, and relative to the test's time without the mutant
DECLARATION = "extern const int pliant_mutant;\n"
DEFINITION = """#include <cstdlib>
extern const int pliant_mutant;
const int pliant_mutant = std::getenv("PLIANT_MUTANT") ? std::atoi(std::getenv("PLIANT_MUTANT")) : 0;
"""


class Mutant:
    def __init__(self, number, floor, key, table):
        self.number, self.floor, self.name, self.table = number, floor, f"{floor}.{key}", table
        self.file, self.breaks, self.killers = table["file"], table["breaks"], table["killers"]
        self.old, self.new = table["old"].strip(), table.get("new", "").strip()
        self.is_branch = self.file.endswith(CODE) and not (
            self.file.endswith(".glsl") and not self.file.startswith(SHARED))
        self.without_device = self.file.startswith(SHARED)

    def place(self, text):
        """Where `old` begins in a text of the file."""
        within = self.table.get("within", "").strip()
        frame = within or self.old
        places = [m.start() for m in re.finditer(re.escape(frame), text)]
        which = self.table.get("which", 1)
        if not places or (len(places) > 1 and "which" not in self.table) or which > len(places):
            raise LookupError(f"{self.name}: its text is {len(places)} times in {self.file}")
        return places[which - 1] + (within.index(self.old) if within else 0)

    def replaced(self, text, by):
        at = self.place(text)
        return text[:at] + by + text[at + len(self.old):]

    def plain(self, text):
        new = self.table["switch"].replace("MUTANT", "true") if "switch" in self.table else self.new
        return self.replaced(text, new)

    def branch(self):
        chosen = f"(pliant_mutant == {self.number})"
        if "switch" in self.table:
            branch = self.table["switch"].strip().replace("MUTANT", chosen)
        elif self.old.endswith((";", "}")):
            branch = f"if {chosen} {{ {self.new} }} else {{ {self.old} }}"
        else:
            branch = f"({chosen} ? ({self.new}) : ({self.old}))"
        if self.without_device:  # which glslc reads, too
            branch = f"\n#ifdef __cplusplus\n{branch}\n#else\n{self.old}\n#endif\n"
        return branch


def load(patterns):
    mutants = []
    for path in sorted((ROOT / "tests/mutants").glob("*.toml")):
        for key, table in tomllib.loads(path.read_text()).items():
            mutants.append(Mutant(len(mutants) + 1, path.stem, key, table))
    lost = []
    for m in mutants:
        try:
            m.place((ROOT / m.file).read_text())
        except (LookupError, OSError) as error:
            lost.append(str(error))
    if lost:
        sys.exit("\n".join(lost))
    chosen = [m for m in mutants if not patterns or any(
        m.floor == p or fnmatch.fnmatch(m.name, p) for p in patterns)]
    if not chosen:
        sys.exit("no mutant has this name; --list shows all")
    return mutants, chosen


def with_branches(mutants):
    """The mutated files, with all mutants as branches."""
    texts = {}
    for m in mutants:
        if not m.is_branch:
            continue
        text = texts.get(m.file) or (ROOT / m.file).read_text()
        # Several mutants of the same text are nested branches.
        frame = m.table.get("within", "").strip() or m.old
        if frame not in text:
            frame = m.old
        if "which" in m.table:
            at = m.place(text)
        else:
            at = text.rindex(frame) + frame.index(m.old)
        texts[m.file] = text[:at] + m.branch() + text[at + len(m.old):]
    for file in texts:
        if file.endswith((".cpp", ".hpp")):
            begin = "#pragma once\n" if file.endswith(".hpp") else ""
            texts[file] = texts[file].replace(begin, begin + DECLARATION, 1) if begin else DECLARATION + texts[file]
    return texts


def write(path, content):
    """Writes only files that differ, to avoid rebuilding."""
    data = content if isinstance(content, bytes) else content.encode()
    if path.is_file() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def copy_tree(texts, wanted_tests):
    """Replaces test files that no mutant needs by empty ones."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\0")
    files = {f for f in listed if f and (ROOT / f).is_file()}
    for file in files:
        is_left_out = file.startswith("tests/") and file.endswith("_test.cpp") and file not in wanted_tests
        write(SOURCE / file, b"" if is_left_out else texts.get(file) or (ROOT / file).read_bytes())
        shutil.copymode(ROOT / file, SOURCE / file)
    # A folder that every file of the library can include from.
    laws = "src/laws/laws.hpp"
    write(SOURCE / laws, (texts.get(laws) or (ROOT / laws).read_text()).replace(
        "#pragma once\n", "#pragma once\n" + DECLARATION, 1))
    write(SOURCE / "src/files/mutant.cpp", DEFINITION)
    for path in SOURCE.rglob("*"):
        name = str(path.relative_to(SOURCE))
        if path.is_file() and name not in files and name != "src/files/mutant.cpp":
            path.unlink()


def run(command, **options):
    return subprocess.run(command, capture_output=True, text=True, errors="replace", **options)


def build(targets, jobs):
    result = run(["ninja", "-C", str(BUILD), f"-j{jobs}", *sorted(targets)])
    return None if result.returncode == 0 else result.stdout[-3000:] + result.stderr[-1000:]


class Killer:
    """A test, or several of a program."""

    def __init__(self, name, command, targets, is_gtest, sources, environment=None):
        self.name, self.command, self.targets, self.is_gtest, self.sources = name, command, targets, is_gtest, sources
        self.environment = environment or {}
        self.lock, self.seen = threading.Lock(), {}

    def run(self, mutant, without_device, left_out=(), timeout=3600, stop=True):
        environment = dict(os.environ, **self.environment)
        if mutant:
            environment["PLIANT_MUTANT"] = str(mutant)
        if without_device:
            environment["VK_DRIVER_FILES"] = environment["VK_ICD_FILENAMES"] = "/nonexistent"
            environment["PLIANT_NO_VULKAN"] = "1"  # tests/test_runners.hpp
        command = list(self.command)
        if self.is_gtest:
            if left_out:
                command[-1] += "-" + ":".join(left_out)
            command += ["--gtest_brief=1"] + (["--gtest_fail_fast"] if stop else [])
        start = time.monotonic()
        process = subprocess.Popen(command, cwd=BUILD, env=environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        try:
            output = process.communicate(timeout=timeout)[0].decode(errors="replace")
            code = process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            output, code = "", "hangs"
        return code, output, time.monotonic() - start

    def baseline(self, without_device):
        """Without a mutant: (why it cannot be used, or None; seconds; tests to leave out)."""
        with self.lock:
            if without_device not in self.seen:
                code, output, seconds = self.run(0, without_device, stop=False)
                failed = sorted(set(re.findall(r"^\[  FAILED  \] ([\w./]+)", output, re.M)))
                ran = re.search(r"(\d+) tests? from \d+ test suites? ran", output)
                problem = None
                if self.is_gtest and (not ran or int(ran[1]) <= len(failed)):
                    problem = "no test without a device" if ran and without_device else "no such test"
                elif code == 77:
                    problem = "skipped"
                elif code != 0 and not (without_device and failed):
                    problem = "red without a mutant"
                self.seen[without_device] = (problem, seconds, failed if without_device else [])
            return self.seen[without_device]


def suites_of_files():
    suites = {}
    for path in sorted((ROOT / "tests").rglob("*_test.cpp")):
        for suite in re.findall(r"^TEST(?:_[FP])?\(\s*(\w+)\s*,", path.read_text(), re.M):
            files = suites.setdefault(suite, [])
            if str(path.relative_to(ROOT)) not in files:
                files.append(str(path.relative_to(ROOT)))
    return suites


def tests_of(mutants):
    """The files of their killers."""
    suites = suites_of_files()
    return {f for m in mutants for name in m.killers for f in suites.get(re.match(r"\w*", name.split()[-1])[0], [])}


class Tests:
    def __init__(self):
        listed = json.loads(run(["ctest", "--show-only=json-v1"], cwd=BUILD).stdout)["tests"]
        self.ctest = {}
        for test in listed:
            if "command" in test:
                properties = {p["name"]: p["value"] for p in test.get("properties", [])}
                environment = dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))
                self.ctest[test["name"]] = (test["command"], environment)
        self.suites, self.known = suites_of_files(), {}

    def killers(self, name):
        if name in self.known:
            return self.known[name]
        found, settings = [], dict(s.split("=", 1) for s in name.split()[:-1])
        whole_name, name = name, name.split()[-1]
        if name in self.ctest:
            command, environment = self.ctest[name]
            targets = [str(Path(a).relative_to(BUILD)) for a in command if a.startswith(str(BUILD / "bin") + "/")]
            scripts = [str(Path(a).relative_to(SOURCE)) for a in command if a.startswith(str(SOURCE)) and Path(a).is_file()]
            found.append(Killer(name, command, targets, False, scripts, dict(environment, **settings)))
        else:
            pattern = name if "." in name or "*" in name else name + ".*"
            suite = re.match(r"\w*", name)[0]
            if suite in self.suites:
                command = [str(BUILD / "bin/pliant_tests"), f"--gtest_filter={pattern}:*/{pattern}"]
                found.append(Killer(name, command, ["bin/pliant_tests"], True, self.suites[suite], settings))
        self.known[whole_name] = found
        return found


def digest(mutant, tests):
    parts = [json.dumps(mutant.table, sort_keys=True), (ROOT / mutant.file).read_text()]
    for name in mutant.killers:
        for killer in tests.killers(name):
            parts += [(ROOT / s).read_text() for s in killer.sources if (ROOT / s).is_file()]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


class Run:
    def __init__(self, options, mutants, chosen):
        self.options, self.mutants = options, mutants
        self.texts = with_branches(mutants)
        WORK.mkdir(parents=True, exist_ok=True)
        copy_tree(self.texts, tests_of(chosen))
        is_new = not (BUILD / "build.ninja").is_file()
        result = run(["cmake", "-S", str(SOURCE), "-B", str(BUILD), *(OPTIONS if is_new else [])])
        if result.returncode:
            sys.exit(result.stdout + result.stderr)
        self.tests = Tests()
        self.results = json.loads(RESULTS.read_text()) if RESULTS.is_file() else {}
        self.digests = {m.name: digest(m, self.tests) for m in chosen}
        self.chosen = chosen
        self.todo = [m for m in chosen if not (options.resume and self.known(m))]
        self.done, self.start, self.lock = 0, time.monotonic(), threading.Lock()

    def known(self, mutant):
        old = self.results.get(mutant.name, {})
        return old.get("digest") == self.digests[mutant.name] and old.get("status") == "killed"

    def note(self, mutant, status, by, seconds):
        with self.lock:
            self.done += 1
            self.results[mutant.name] = {"status": status, "by": by, "seconds": round(seconds, 1),
                                         "digest": self.digests[mutant.name]}
            RESULTS.write_text(json.dumps(self.results, indent=1, sort_keys=True))
            elapsed = time.monotonic() - self.start
            left = elapsed / self.done * (len(self.todo) - self.done)
            say(f"[{self.done:3}/{len(self.todo)}] {status:8} {mutant.name}  {by}  "
                f"({seconds:.0f} s; {clock(elapsed)} gone, about {clock(left)} left)")

    def try_killers(self, mutant, number):
        """The first killer that fails, and a note on those that could not be used."""
        unusable = []
        without_device = mutant.without_device and number > 0
        for name in mutant.killers:
            killers = self.tests.killers(name)
            if not killers:
                unusable.append(f"{name}: no such test")
            for killer in killers:
                problem, seconds, left_out = killer.baseline(without_device)
                if problem:
                    unusable.append(f"{name}: {problem}")
                    continue
                code, output, _ = killer.run(number, without_device, left_out,
                                             max(LEAST_TIMEOUT, TIMES_LONGER * seconds))
                if code not in (0, 77):
                    failed = re.search(r"^\[  FAILED  \] ([\w./]+)", output, re.M)
                    by = failed[1] if failed else name
                    return by + (" (hangs)" if code == "hangs" else "" if failed or not killer.is_gtest else
                                 " (ends early)"), unusable
        return None, unusable

    def branches(self):
        """Runs all mutants that are branches of one build; returns the survivors."""
        alive, branches = [], [m for m in self.todo if m.is_branch]
        if not branches:
            return alive
        targets = {t for m in branches for name in m.killers for k in self.tests.killers(name) for t in k.targets}
        say(f"building {len(branches)} mutants as branches of one program")
        if problem := build(targets, self.options.jobs):
            sys.exit(problem)
        say(f"built in {clock(time.monotonic() - self.start)}")

        def attempt(mutant):
            start = time.monotonic()
            by, unusable = self.try_killers(mutant, mutant.number)
            if by:
                self.note(mutant, "killed", by, time.monotonic() - start)
            else:
                with self.lock:
                    alive.append(mutant)
                say(f"          alive    {mutant.name}  {'; '.join(unusable)}")

        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            list(pool.map(attempt, branches))
        return alive

    def alone(self, mutant):
        """Runs one mutant in a separate build."""
        start = time.monotonic()
        broken = mutant.plain((ROOT / mutant.file).read_text())
        write(SOURCE / mutant.file, broken)
        try:
            by = None
            if not mutant.is_branch:
                targets = {t for name in mutant.killers for k in self.tests.killers(name) for t in k.targets}
                if targets and (problem := build(targets, self.options.jobs)):
                    say(problem)
                    return self.note(mutant, "error", "does not build", time.monotonic() - start)
                by, unusable = self.try_killers(mutant, 0)
                if unusable:
                    say("          " + "; ".join(unusable))
            if not by and not self.options.named_only:
                by = self.quick_tests(mutant, broken)
            self.note(mutant, "killed" if by else "survived", by or "", time.monotonic() - start)
        finally:
            self.restore(mutant)

    def quick_tests(self, mutant, broken):
        """Runs all quick tests on a survivor; returns the first that fails with the mutant only."""
        red_anyway = set()
        copy_tree(dict(self.texts, **{mutant.file: broken}), {str(p.relative_to(ROOT)) for p in (ROOT / "tests").rglob("*")})
        while True:
            if problem := build([], self.options.jobs):
                say(problem)
                return None
            left_out = ["-E", "^(" + "|".join(red_anyway) + ")$"] if red_anyway else []
            result = run(["ctest", "-L", "quick", "--stop-on-failure", "--timeout", "1800", *left_out], cwd=BUILD)
            failed = re.search(r"^\s*\d+ - (\S+) \(", result.stdout, re.M)
            if not failed:
                return None
            self.restore(mutant)
            build([], self.options.jobs)
            if run(["ctest", "-R", f"^{re.escape(failed[1])}$"], cwd=BUILD).returncode == 0:
                return failed[1]
            red_anyway.add(re.escape(failed[1]))  # tests of source rules, which branches violate
            write(SOURCE / mutant.file, broken)

    def restore(self, mutant):
        write(SOURCE / mutant.file, self.texts.get(mutant.file) or (ROOT / mutant.file).read_text())

    def shaders_as_they_are(self):
        """Killers of mutants that are built separately must pass in the build without mutants."""
        names = {name for m in self.todo if not m.is_branch for name in m.killers}
        killers = [k for name in names for k in self.tests.killers(name)]
        targets = {t for k in killers for t in k.targets}
        if targets and (problem := build(targets, self.options.jobs)):
            sys.exit(problem)
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            list(pool.map(lambda k: k.baseline(False), killers))

    def all(self):
        left = self.branches()
        self.shaders_as_they_are()
        alone = [m for m in self.todo if not m.is_branch]
        for mutant in sorted(alone, key=lambda m: m.file):
            self.alone(mutant)
        for mutant in left:
            self.alone(mutant)

    def table(self):
        rows = []
        for floor in dict.fromkeys(m.floor for m in self.chosen):
            of = [self.results.get(m.name, {}).get("status", "open") for m in self.chosen if m.floor == floor]
            rows.append((floor, len(of), of.count("killed"), of.count("survived"), len(of) - of.count("killed") - of.count("survived")))
        rows.append(("all", *(sum(r[k] for r in rows) for k in range(1, 5))))
        return rows


def say(text):
    print(text, flush=True)


def clock(seconds):
    return f"{int(seconds) // 60}:{int(seconds) % 60:02}"


def markdown(rows, chosen, results):
    lines = ["| floor | mutants | killed | survived |", "| --- | --- | --- | --- |"]
    lines += [f"| {r[0]} | {r[1]} | {r[2]} | {r[3]} |" for r in rows]
    lines += ["", "| mutant | what it breaks | noticed by |", "| --- | --- | --- |"]
    lines += [f"| `{m.name}` | {m.breaks} | `{results.get(m.name, {}).get('by', '')}` |" for m in chosen]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--only", nargs="+", default=[], metavar="FLOOR|PATTERN")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--named-only", action="store_true")
    parser.add_argument("--markdown", metavar="FILE", help="write the tables of docs/verification.md")
    options = parser.parse_args()
    mutants, chosen = load(options.only)
    if options.list:
        for m in chosen:
            say(f"{m.name}: {m.breaks} ({m.file})")
        return 0
    whole = Run(options, mutants, chosen)
    whole.all()
    rows = whole.table()
    say(f"\n{'floor':12} {'tried':>6} {'killed':>7} {'survived':>9} {'no result':>10}")
    for row in rows:
        say("{:12} {:6} {:7} {:9} {:10}".format(*row))
    for m in chosen:
        result = whole.results.get(m.name, {})
        if result.get("status") != "killed":
            say(f"{result.get('status', 'open')}: {m.name}: {m.breaks}")
    if options.markdown:
        Path(options.markdown).write_text(markdown(rows, chosen, whole.results))
    return 0 if rows[-1][1] == rows[-1][2] else 1


if __name__ == "__main__":
    sys.exit(main())
