#!/usr/bin/env python3
"""Do the tests notice a wrong token? (make mutants N=60)

Changes one token of lib/avi at random - an operator, a comparison, a constant - and compiles and runs the unit
and property tests that include the file until one fails: the nearest first, at most MOST_TESTS of them. A mutant
that none of them notices is printed as SURVIVED. One that does not compile is replaced by another. The library
is not touched: the changed header lies in a folder of its own that the compiler searches first. As many changes
are tried at a time as there are processors.
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
EIGEN = "/usr/include/eigen3"
# With the checks of Eigen and of the standard library, which notice an index that is out of range.
FLAGS = ["-std=c++20", "-ffp-contract=off", "--param=ggc-min-heapsize=1000000", "-D_GLIBCXX_ASSERTIONS", "-w", "-Wno-psabi",
         *(f"-I{folder}" for folder in (LIB, ROOT / "tests", ROOT / "experiments")), "-isystem", EIGEN,
         *(f'-DAVI_{name}="{value}"' for name, value in
           {"SOURCE_DIR": ROOT, "CHECK_DIR": BUILD, "BUILD_DIR": BUILD, "BIN_DIR": BUILD,
            "PUBLISHED_DIR": ROOT / "paper" / "published"}.items())]

MOST_TESTS = 8  # what the nearest ones let pass, the others let pass as a rule

# A compiler cache does not notice that a header now lies earlier in the search path.
ENVIRONMENT = {**os.environ, "CCACHE_DISABLE": "1"}
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
    found = []
    for number, line in enumerate(path.read_text().splitlines()):
        code = line.split("//")[0]
        if code.lstrip().startswith(("#", "template", "requires", "static_assert", "/*", "*", "[[")) or "operator" in code:
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


@functools.cache
def included(file):
    """The files of this repository that a file includes."""
    names = re.findall(r'^#include "(.*)"', file.read_text(), re.MULTILINE)
    return [folder / name for name in names for folder in (LIB, ROOT / "tests", ROOT / "experiments", ROOT / "paper")
            if (folder / name).exists()]


def is_linked(header):
    """Whether it declares what a source beside it defines."""
    return header.suffix == ".hpp" and header.with_suffix(".cpp").exists()


class Tests:
    """The unit and property tests, and what each includes. Left out are those that compare times or link more than the library."""

    def __init__(self, compiler):
        self.compiler, self.turn = compiler, threading.Lock()
        for level in ("-O0", "-O1"):  # precompiled: half of the time of a small test
            common = BUILD / level / "common.hpp"
            common.parent.mkdir(parents=True, exist_ok=True)
            common.write_text("".join(f"#include <{name}>\n" for name in COMMON))
            run(compiler + FLAGS + [level, "-x", "c++-header", str(common), "-o", f"{common}.gch"], 600)
        cmake = (ROOT / "tests/CMakeLists.txt").read_text()  # which says what is optimised or compares times
        self.slow = set(re.search(r"set\(slow_tests ([^)]*)\)", cmake).group(1).split())
        timed = re.findall(r"a_test\(LABEL \w+ NAME (\w+) ALONE", cmake)
        sources = [file for label in ("unit", "property") for file in sorted(ROOT.glob(f"tests/{label}/*_test.cpp"))]
        all_steps = {source: self.steps_from(source) for source in sources}
        self.tests = {source: steps for source, steps in all_steps.items()
                      if source.stem.removesuffix("_test") not in timed and not any(map(is_linked, steps))}

    def steps_from(self, test):
        """Every file that a test includes, and how many includes lead to it."""
        steps, level, count = {test: 0}, {test}, 0
        while level:
            count += 1
            level = {file for above in level for file in included(above)} - steps.keys()
            steps |= dict.fromkeys(level, count)
        return steps

    def of(self, header, name):
        """Those that include the header: its own first, then those that speak of `name`, then the nearest and smallest."""
        mine = [test for test, steps in self.tests.items() if header in steps]
        return sorted(mine, key=lambda test: (test.stem != header.stem + "_test",
                                              name is None or not re.search(rf"\b{name}\b", test.read_text()),
                                              self.tests[test][header], len(self.tests[test])))

    def fails(self, test, folder, overlay=()):
        """Compiles a test in `folder`, with what the overlay changes, and runs it. None where it does not compile."""
        program, level = folder / test.stem, "-O1" if test.stem.removesuffix("_test") in self.slow else "-O0"
        command = self.compiler + [*overlay, *FLAGS, level, "-include", str(BUILD / level / "common.hpp"), str(test),
                                   "-o", str(program), "-lgtest_main", "-lgtest", "-lgsl", "-lgslcblas"]
        if run(command, 1800) != 0:
            return None
        return run([str(program), "--gtest_fail_fast"], 120) != 0

    def passes_unchanged(self, test):
        """Whether the test passes with the library as it is; found out once for each state of its headers."""
        passed, newest = BUILD / f"{test.stem}.passed", max(file.stat().st_mtime for file in self.tests[test])
        with self.turn:
            if not passed.exists() or passed.stat().st_mtime < newest:
                passed.unlink(missing_ok=True)
                if self.fails(test, BUILD) is False:
                    passed.touch()
            return passed.exists()


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
    changed.parent.mkdir(parents=True, exist_ok=True)
    changed.write_text("".join(lines))
    begin, noticed, tried = time.time(), None, 0
    for test in tests.of(path, enclosing_name(lines, number)):
        failed = tests.fails(test, folder, [f"-I{folder}"])
        if failed is None:
            if not tests.passes_unchanged(test):
                continue
            if tried > 0:
                noticed = f"{test.stem}, which does not compile"
            break  # a token that does not compile where it is used first is no mutant
        tried += 1
        if failed and tests.passes_unchanged(test):
            noticed = test.stem
        if noticed or tried == MOST_TESTS:
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
    places = [(path, *token) for path in sorted(LIB.rglob("*.hpp")) if options.only in str(path) and path.name != "avi.hpp"
              for token in tokens_of(path)]
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
