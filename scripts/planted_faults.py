#!/usr/bin/env python3
"""Plants the faults of test/planted_faults/faults.txt one by one, each in a copy of the sources, and runs
the test that has to fail of each.

Prints a table in the end. Ends with 0 only if each fault was caught by its test, which passes without it.
"""

import argparse
import collections
import fnmatch
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

COPIED = ("include", "models", "src", "test")
PATIENCE = 120  # for one test program [s]

Fault = collections.namedtuple("Fault", "name file program filter why text wrong")
Run = collections.namedtuple("Run", "ended passed failed running")


class Problem(Exception):
    """Why the faults cannot be planted."""


def make_fault(fields, lines):
    """The fault that a paragraph of the list describes."""
    name = fields.get("fault", "without a name")
    missing = [key for key in ("fault", "why", "file", "test") if not fields.get(key)]
    test = fields.get("test", "").split()
    if missing or len(test) != 2 or not lines["-"]:
        raise Problem(f"fault {name} needs why, file, test with a filter and lines with -"
                      + "".join(f"; there is no {key}" for key in missing))
    text, wrong = ("".join(line + "\n" for line in lines[sign]) for sign in "-+")
    return Fault(name, fields["file"], test[0], test[1], fields["why"], text, wrong)


def read_list(path):
    """The faults in the list, by name."""
    faults = {}
    for paragraph in re.split(r"\n{2,}", path.read_text(encoding="utf-8")):
        fields, lines = {}, {"-": [], "+": []}
        for line in paragraph.strip("\n").split("\n"):
            if line[:1] in lines:
                lines[line[0]].append(line[1:])
            elif line and not line.startswith("#"):
                key, _, value = line.partition(" ")
                fields[key] = value
        if fields or lines["-"] or lines["+"]:
            fault = make_fault(fields, lines)
            if fault.name in faults:
                raise Problem(f"fault {fault.name} is in the list twice")
            faults[fault.name] = fault
    return faults


def choose(faults, names):
    """Those of these names, all of them without any."""
    unknown = [name for name in names if name not in faults]
    if unknown:
        raise Problem(f"there is no fault {', '.join(unknown)}; there are {', '.join(faults)}")
    return [fault for fault in faults.values() if not names or fault.name in names]


def planted(fault, source):
    """The file with the fault in it."""
    try:
        text = (source / fault.file).read_text(encoding="utf-8")
    except OSError as error:
        raise Problem(f"fault {fault.name}: {error}") from None
    places = ("\n" + text).count("\n" + fault.text)
    if places != 1:
        raise Problem(f"fault {fault.name}: its text is in {fault.file} {places} times, must be there "
                      "once: has the code changed?")
    return ("\n" + text).replace("\n" + fault.text, "\n" + fault.wrong)[1:]


def copy_sources(source, copy):
    """Makes the copy the same as the sources; what is the same already is not touched."""
    wanted = {path.relative_to(source) for folder in COPIED
              for path in (source / folder).rglob("*") if path.is_file()}
    for path in copy.rglob("*"):
        if path.is_file() and path.relative_to(copy) not in wanted:
            path.unlink()
    for path in sorted(wanted):
        there = copy / path
        if not there.is_file() or there.read_bytes() != (source / path).read_bytes():
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source / path, there)


class Bench:
    """Where the copy is built and its tests are run."""

    def __init__(self, source, folder, messages):
        self._source = source
        self._copy = folder / "source"
        self._build = folder / "build"
        copy_sources(source, self._copy)
        self._command(["cmake", "-S", self._copy / "test/planted_faults", "-B", self._build,
                       "-G", "Ninja", f"-DCLOTH_TEARING_MESSAGES={messages}"])

    def _command(self, command):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              encoding="utf-8", check=False)
        if done.returncode != 0:
            raise Problem(f"{command[0]} ended with {done.returncode}:\n{done.stdout[-5000:]}")

    def write(self, file, text):
        (self._copy / file).write_text(text, encoding="utf-8")

    def restore(self, file):
        shutil.copyfile(self._source / file, self._copy / file)

    def build(self, programs):
        self._command(["cmake", "--build", self._build, "--parallel", str(os.cpu_count()),
                       "--target", *programs])

    def run(self, program, pattern):
        """Runs tests of a program to its end, or until patience is over."""
        command = [self._build / program, f"--gtest_filter={pattern}", "--gtest_color=no"]
        try:
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  timeout=PATIENCE, cwd=self._build, check=False)
            output, status = done.stdout, done.returncode
            ended = f"with {signal.Signals(-status).name}" if status < 0 else status
        except subprocess.TimeoutExpired as error:
            output, ended = error.stdout or b"", f"not within {PATIENCE} s"
        text = output.decode("utf-8", "replace")

        def named(mark):
            return re.findall(rf"^\[ *{mark} *\] ([\w/]+\.[\w/]+)", text, re.MULTILINE)

        started = named("RUN")
        return Run(ended, named("OK"), list(dict.fromkeys(named("FAILED"))), started[-1:])


def check_sound(bench, faults):
    """Demands that the tests are there and pass where nothing is planted."""
    filters = collections.defaultdict(list)
    for fault in faults:
        filters[fault.program].append(fault.filter)
    bench.build(list(filters))
    for program, patterns in filters.items():
        run = bench.run(program, ":".join(patterns))
        if run.ended != 0:
            names = ", ".join(run.failed or run.running)
            raise Problem(f"{program} fails without any fault: {names} (ended {run.ended})")
        for pattern in patterns:
            if not fnmatch.filter(run.passed, pattern):
                raise Problem(f"{program} has no test {pattern}")


def catcher(run):
    """Which test has caught the fault; an empty text if none has."""
    if run.ended == 0:
        return ""
    if run.failed:
        more = len(run.failed) - 1
        return f"`{run.failed[0]}`" + (f" and {more} more" if more else "")
    return f"`{''.join(run.running) or 'the program'}`, ended {run.ended}"


def plant(bench, fault, text):
    """Plants one fault and takes it out again. @return which test has caught it"""
    bench.write(fault.file, text)
    try:
        bench.build([fault.program])
        return catcher(bench.run(fault.program, fault.filter))
    except Problem as problem:
        raise Problem(f"fault {fault.name}: {problem}") from None
    finally:
        bench.restore(fault.file)


def print_table(rows):
    """As it stands in docs/reliability.md."""
    print("\n| fault | file | caught by |\n| --- | --- | --- |")
    for fault, caught in rows:
        print(f"| {fault.name} | `{fault.file}` | {caught or 'NOTHING'} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("messages", type=pathlib.Path)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    started = time.monotonic()
    faults = choose(read_list(arguments.source / "test/planted_faults/faults.txt"), arguments.names)
    texts = [planted(fault, arguments.source) for fault in faults]
    bench = Bench(arguments.source, arguments.folder, arguments.messages)
    check_sound(bench, faults)
    rows = []
    for fault, text in zip(faults, texts):
        rows.append((fault, plant(bench, fault, text)))
        print(f"{fault.name}: {rows[-1][1] or 'NOTHING caught it'}", flush=True)
    print_table(rows)
    caught = sum(1 for _, name in rows if name)
    print(f"\n{caught} of {len(rows)} planted faults were caught, "
          f"in {time.monotonic() - started:.0f} s")
    return 0 if caught == len(rows) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Problem as problem:
        sys.exit(f"plant_faults: {problem}")
