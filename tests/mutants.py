#!/usr/bin/env python3
"""Do the tests notice a wrong token? (make mutants N=60)

Changes one token of lib/avi or lib/src at random - an operator, a comparison, a constant - and compiles and runs the unit,
property and stability tests that include the file until one fails: the nearest first, at most MOST_TESTS of them. Where the
library's own sources are or include the file, these are compiled with the change, linked before what the library has
unchanged to one program of all tests, and tried by those that call them, the nearest first, then by the ways of solve()
through systems drawn at random, the others, the short hostile draw last. A mutant
that none of them notices is printed as SURVIVED. One that does not compile is replaced by another, and so is one that cannot be
noticed by construction: where the compiler makes the same instructions of it. The library is not touched: the changed file lies
in a folder of its own that the compiler searches first. As many changes are tried at a time as there are processors.
"""
import argparse
import functools
import os
import random
import re
import shutil
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LIB, BUILD = ROOT / "lib", ROOT / "build" / "mutants"
SOURCES = sorted((LIB / "src").rglob("*.cpp"))
HOSTILE, WAYS = ROOT / "tests/hostile/hostile.cpp", ROOT / "tests/hostile/ways.cpp"
EIGEN = "/usr/include/eigen3"
# With the checks of Eigen and of the standard library, which notice an index that is out of range.
FLAGS = ["-std=c++20", "-ffp-contract=off", "--param=ggc-min-heapsize=1000000", "-D_GLIBCXX_ASSERTIONS", "-w", "-Wno-psabi",
         *(f"-I{folder}" for folder in (LIB, ROOT / "tests", ROOT / "experiments")), "-isystem", EIGEN,
         *(f'-DAVI_{name}="{value}"' for name, value in
           {"SOURCE_DIR": ROOT, "CHECK_DIR": BUILD, "BUILD_DIR": BUILD, "BIN_DIR": BUILD,
            "PUBLISHED_DIR": ROOT / "paper" / "published"}.items())]

MOST_TESTS = 6  # what the nearest ones let pass, the others let pass as a rule
PATIENCE = 60  # seconds for one test

# A compiler cache does not notice that a header now lies earlier in the search path.
ENVIRONMENT = {**os.environ, "CCACHE_DISABLE": "1"}
GTEST = ["-lgtest_main", "-lgtest", "-lgsl", "-lgslcblas"]
ARGUMENTS = {HOSTILE: "--systems 40 --seed 11 --tolerances 1e-4,1e-8,1e-12 --longest 10 --work 2e7 --seconds 30 --quiet".split(),
             WAYS: [str(WAYS.with_suffix(".tsv"))]}
COMMON = ["Eigen/Core", "Eigen/LU", "gtest/gtest.h", "algorithm", "cmath", "functional", "string", "vector"]

# Binary operators stand between blanks (clang-format sees to that); template brackets do not.
OPERATORS = {"+": "-", "-": "+", "*": "/", "/": "*", "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==",
             "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
TOKEN = re.compile(r"(?<= )(?P<operator>[-+*/<>=!]=|&&|\|\||[-+*/<>])(?= )"
                   r"|(?<![\w.<])(?P<number>\d+(?:\.\d*)?(?:e[-+]?\d+)?L?)(?![\w.>])"
                   r"|\b(?P<truth>true|false)\b")


def changed_number(text, rng):
    if re.fullmatch(r"\d+", text):
        return str(int(text) + rng.choice([1, -1] if int(text) > 0 else [1]))
    suffix = "L" if text.endswith("L") else ""
    value = float(text.rstrip("L"))
    return repr(value * rng.choice([0.5, 2.0]) if value else 1.0) + suffix


def tokens_of(path):
    """Every token that may be changed: (line, first column, last column, kind)."""
    found, asserting = [], False
    for number, line in enumerate(path.read_text().splitlines()):
        code = line.split("//")[0]
        asserting = asserting or code.lstrip().startswith("static_assert")
        skipped, asserting = asserting, asserting and not code.rstrip().endswith(";")
        if skipped or code.lstrip().startswith(("#", "template", "requires", "/*", "*", "[[")) or "operator" in code:
            continue
        code = re.sub(r'"(\\.|[^"\\])*"', lambda m: " " * len(m.group()), code)
        for match in TOKEN.finditer(code):
            found.append((number, match.start(), match.end(), match.lastgroup))
    return found


# The head of a class, or of a function with the type that it returns.
DEFINITION = re.compile(r"(?:class|struct)(?: alignas\(\d+\))? (\w+)(?!;)|"
                        r"(?!return|else|const auto|throw|using|typename)(?:\[\[.*?\]\] )?[\w:<>,&* ]+[ &*](\w+)\([^;=]*(?:[{,]|\{.*\}|\))$")


def enclosing_name(lines, number):
    """The function or class that a line belongs to, by the last definition above it."""
    for line in reversed(lines[:number + 1]):
        found = DEFINITION.match(line.split("//")[0].strip())
        if found:
            return found.group(1) or found.group(2)
    return None


def run(command, patience):
    try:
        return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=patience,
                              cwd=BUILD, env=ENVIRONMENT).returncode
    except subprocess.TimeoutExpired:
        return "timeout"


def code_of(part):
    """The instructions and constants of an object, without what is said of lines."""
    copy = part.with_suffix(".code")
    subprocess.run(["objcopy", "--strip-debug", "--remove-section=.comment", str(part), str(copy)], check=True)
    return copy.read_bytes()


@functools.cache
def included(file):
    """The files of this repository that a file includes."""
    names = re.findall(r'^#include "(.*)"', file.read_text(), re.MULTILINE)
    return [folder / name for name in names for folder in (LIB, file.parent, ROOT / "tests", ROOT / "experiments", ROOT / "paper")
            if (folder / name).exists()]


@functools.cache
def defined_in(header):
    """The library's sources that define what a header declares: they have its name, or include it first."""
    return [source for source in SOURCES if source.stem == header.stem or included(source)[0] == header]


def steps_from(file, linked=False):
    """Every file that a file includes - and that is linked with it - and how many includes lead to it."""
    steps, level, count = {file: 0}, {file}, 0
    while level:
        count += 1
        level = {below for above in level for below in included(above) + (defined_in(above) if linked else [])} - steps.keys()
        steps |= dict.fromkeys(level, count)
    return steps


def is_linked(header):
    """Whether it declares what a source beside it defines, outside the library."""
    return header.suffix == ".hpp" and header.with_suffix(".cpp").exists() and LIB not in header.parents


class Tests:
    """The tests, and what each includes. Left out are those that compare times or link more than the library."""

    def __init__(self, compiler):
        self.compiler, self.turn, self.seconds = compiler, threading.Lock(), {}
        for level in ("-O0", "-O1"):  # precompiled: half of the time of a small test
            common = BUILD / level / "common.hpp"
            common.parent.mkdir(parents=True, exist_ok=True)
            common.write_text("".join(f"#include <{name}>\n" for name in COMMON))
            if not Path(f"{common}.gch").exists():
                run(compiler + FLAGS + [level, "-x", "c++-header", str(common), "-o", f"{common}.gch"], 600)
        cmake = (ROOT / "tests/CMakeLists.txt").read_text()  # which says what is optimised or compares times
        self.slow = set(re.search(r"set\(slow_tests ([^)]*)\)", cmake).group(1).split())
        timed = re.findall(r"a_test\(LABEL \w+ NAME (\w+) ALONE", cmake)
        found = [file for label in ("unit", "property", "stability") for file in sorted(ROOT.glob(f"tests/{label}/*_test.cpp"))]
        self.included = {test: steps_from(test) for test in found if test.stem.removesuffix("_test") not in timed}
        self.included = {test: steps for test, steps in self.included.items() if not any(map(is_linked, steps))}
        self.linked = {test: steps_from(test, linked=True) for test in self.included}
        self.linked[HOSTILE] = self.linked[WAYS] = steps_from(HOSTILE.with_name("call.cpp"), linked=True)
        self.together = [test for test in self.included if ROOT / "tests/allocations.hpp" not in self.linked[test]]  # these count theirs alone
        self.within = {source: steps_from(source) for source in SOURCES}
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            parts = list(pool.map(lambda source: self.object_of(source, BUILD, []), SOURCES))
            objects = list(pool.map(lambda test: self.object_of(test, BUILD, []), self.together))
        assert all(parts), "the library does not compile"
        self.parts = parts
        self.library = BUILD / "libavi.a"
        self.library.unlink(missing_ok=True)
        run(["ar", "rcs", str(self.library), *map(str, parts)], 600)
        self.main = self.object_of(ROOT / "tests/main.cpp", BUILD, [])
        self.together = [test for test, built in zip(self.together, objects) if built]
        self.objects = [built for built in objects if built]

    def including(self, header, name):
        """The tests that include the header: its own first, then those of headers that include it, then those that speak of `name`, then
        the nearest and smallest."""
        tests = self.nearest(self.included, [header], header.stem, name)
        above = {f"{file.stem}_test" for steps in self.included.values() for file in steps if header in included(file)}
        return sorted(tests, key=lambda test: 0 if test.stem == header.stem + "_test" else 1 if test.stem in above else 2)[:MOST_TESTS]

    def calling(self, changed, users, name):
        """The tests that are linked with one of the library's sources that include the file, in that order."""
        callers = self.nearest(self.linked, users, changed.stem, name)
        others = [test for test in callers if test not in (HOSTILE, WAYS)]
        return others[:1] + [WAYS] * (WAYS in callers) + others[1:] + [HOSTILE] * (HOSTILE in callers)

    def nearest(self, all_steps, files, stem, name):
        def rank(test):
            text = test.read_text()
            return (test.stem != stem + "_test", name is None or not re.search(rf"\b{name}\b", text), stem not in text,
                    min(all_steps[test].get(file, 99) for file in files), len(all_steps[test]))

        return sorted((test for test, steps in all_steps.items() if not steps.keys().isdisjoint(files)), key=rank)

    def object_of(self, source, folder, overlay):
        """A source compiled in `folder`, anew where what it includes has changed; None where it does not compile."""
        result = folder / f"{source.stem}.o"
        newest = max(file.stat().st_mtime for file in steps_from(source))
        if overlay or not result.exists() or result.stat().st_mtime < newest:
            is_test = source.parent.name in ("unit", "property", "stability")
            level = "-O1" if not is_test or source.stem.removesuffix("_test") in self.slow else "-O0"
            common = ["-include", str(BUILD / level / "common.hpp")] if is_test else []
            place = folder / source.relative_to(LIB) if overlay and source in SOURCES else source
            if run(self.compiler + [*overlay, *FLAGS, level, *common, "-c", str(place), "-o", str(result)], 1800) != 0:
                result.unlink(missing_ok=True)
                return None
        return result

    def fails(self, test, folder, overlay=(), changed=(), patience=PATIENCE):
        """Compiles a test in `folder` with what the overlay changes, or takes it as it is from the program of all tests, which is linked
        once with changed parts of the library, and runs it. None where it does not compile. The library comes first: of inline functions
        the linker keeps the first one, and those of tests are not optimised."""
        if not overlay and test in self.together:
            program = folder / "all_tests"
            parts = [*changed, *(part for part in self.parts if part.name not in {it.name for it in changed})]
            if not program.exists() and run(self.compiler + [*map(str, [*parts, self.main, *self.objects]), "-o", str(program),
                                                             *GTEST[1:], "-lpthread"], 600) != 0:
                return None
            return self.timed(test, [str(program), test.stem, "--gtest_fail_fast"], patience)
        sources = [test]
        if test in (HOSTILE, WAYS):  # each a program of its own, with what both draw from
            sources += [source for source in sorted(test.parent.glob("*.cpp")) if source.stem not in ("hostile", "ways", "reference_test")]
        objects = [self.object_of(source, folder if overlay else BUILD, list(overlay)) for source in sources]
        program = folder / test.stem
        libraries = ["-lfmt"] if test in (HOSTILE, WAYS) else GTEST
        if not all(objects) or run(self.compiler + [*map(str, [*changed, *objects, self.library]), "-o", str(program), *libraries,
                                                    "-lpthread"], 600) != 0:
            return None
        return self.timed(test, [str(program), *ARGUMENTS.get(test, ["--gtest_fail_fast"])], patience)

    def timed(self, test, command, patience):
        begin = time.time()
        failed = run(command, patience) != 0
        self.seconds[test] = time.time() - begin
        # Tests of two changes that write files of one name at a time are in each other's way: a failure has to come again.
        return failed and (self.seconds[test] >= patience or run(command, patience) != 0)

    def passes_unchanged(self, test):
        """Whether the test passes with the library as it is, then the seconds that it takes; found out once for each state of its files."""
        passed, newest = BUILD / f"{test.stem}.passed", max(file.stat().st_mtime for file in self.linked[test])
        with self.turn:
            if not passed.exists() or passed.stat().st_mtime < newest:
                passed.unlink(missing_ok=True)
                folder = BUILD / "unchanged"
                folder.mkdir(exist_ok=True)
                if self.fails(test, folder, patience=4 * PATIENCE) is False:
                    passed.write_text(str(self.seconds[test]))
            return max(float(passed.read_text()), 0.01) if passed.exists() else None


def judged(tests, rng_state, place):
    """What becomes of a mutant: None where it is none, else (where, seconds, who noticed it or None, what was tried)."""
    drawn, (path, number, first, last, kind) = place
    rng = random.Random(rng_state)
    lines = path.read_text().splitlines(keepends=True)
    old = lines[number][first:last]
    new = {"operator": lambda: OPERATORS[old], "truth": lambda: {"true": "false", "false": "true"}[old],
           "number": lambda: changed_number(old, rng)}[kind]()
    lines[number] = lines[number][:first] + new + lines[number][last:]
    folder = BUILD / f"changed_{drawn}"
    changed = folder / path.relative_to(LIB)
    shutil.copytree(LIB / "src", folder / "src")  # what is included by quotes is looked for beside the file first
    changed.parent.mkdir(parents=True, exist_ok=True)
    changed.write_text("".join(lines))
    begin, noticed, tried, name = time.time(), None, 0, enclosing_name(lines, number)
    overlay, is_none = [f"-I{folder}"], False
    for test in tests.including(path, name) if path.suffix == ".hpp" else []:
        failed = tests.fails(test, folder, overlay)
        if failed is None:
            if tests.passes_unchanged(test) is None:
                continue
            noticed = f"{test.stem}, which does not compile" if tried > 0 else None
            is_none = tried == 0  # a token that does not compile where it is used first is no mutant
            break
        tried += 1
        if failed and tests.passes_unchanged(test) is not None:
            noticed = test.stem
            break
    users = [source for source in SOURCES if path in tests.within[source]]
    if users and not noticed and not is_none:
        parts = [tests.object_of(source, folder, overlay) for source in users]
        same = all(parts) and all(code_of(part) == code_of(BUILD / part.name) for part in parts)
        if same and tried == 0:
            is_none = True  # the compiler sees no difference
        for test in tests.calling(path, users, name) if all(parts) and not same else []:
            if (seconds := tests.passes_unchanged(test)) is None:
                continue
            tried += 1
            if tests.fails(test, folder, changed=parts, patience=10 + 10 * seconds):
                noticed = test.stem
                break
    shutil.rmtree(folder)
    where = f"{path.relative_to(ROOT)}:{number + 1}: {old} -> {new}"
    return (where, time.time() - begin, noticed, f"{tried} tests: {''.join(lines[number]).strip()}") if tried else None


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("-n", type=int, default=60, help="number of mutants")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--after", type=int, default=0, help="go on after so many of the draw, as an earlier run printed")
    options.add_argument("--only", default="", help="files whose path contains this")
    options.add_argument("--jobs", type=int, default=os.cpu_count(), help="changes tried at a time")
    options = options.parse_args()
    rng = random.Random(options.seed)
    launcher = os.environ.get("CMAKE_CXX_COMPILER_LAUNCHER")
    tests = Tests(([launcher] if launcher else []) + [os.environ.get("CXX", "g++")])
    files = [path for path in sorted(LIB.rglob("*.?pp")) if path.relative_to(LIB).parts[0] in ("avi", "src")]
    places = [(path, *token) for path in files if options.only in str(path) and path.name != "avi.hpp" for token in tokens_of(path)]
    rng.shuffle(places)
    drawn = list(enumerate(places, 1))[options.after:]
    done, survivors = 0, []
    with ThreadPoolExecutor(options.jobs) as pool:
        running = []
        while done < options.n and (drawn or running):
            while drawn and len(running) < min(2 * options.jobs, options.n - done):
                running.append((drawn[0][0], pool.submit(judged, tests, f"{options.seed} {drawn[0][0]}", drawn[0])))
                drawn.pop(0)
            number, result = running.pop(0)
            if (verdict := result.result()) is None:
                continue
            where, seconds, noticed, tried = verdict
            done += 1
            if not noticed:
                survivors.append(where)
            print(f"{done:3} ({number}) {seconds:4.0f} s  {where:60}  "
                  f"{f'noticed by {noticed}' if noticed else f'SURVIVED {tried}'}", flush=True)
    print(f"{done - len(survivors)} of {done} changes are noticed (seed {options.seed}).")
    for place in survivors:
        print("  survived:", place)


if __name__ == "__main__":
    sys.exit(main())
