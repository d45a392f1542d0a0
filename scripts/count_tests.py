#!/usr/bin/env python3
"""Counts test cases, not test programs, after a run of ctest: passed, failed, skipped.

Goes through the tests that are registered (ctest --show-only=json-v1), looks up what ctest reported
about each (ctest --output-junit) and, for a gtest or a rostest, what the program itself wrote. A
program that crashed, hung, was not run, or left no test case behind counts as one failed case.
So does a run without any gtest or rostest. Prints every failed case and every reason to skip, then
the counts alone on a line. Ends with 0 only if nothing failed.
"""

import argparse
import collections
import json
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

PROGRAM = re.compile(r"_ctest_cloth_tearing_(?P<kind>gtest|rostest)_(?P<name>.+)")


def read_xml(path):
    """The root of an XML file; None if it is missing or broken off."""
    try:
        return ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError):
        return None


def result_files(results, program):
    """The files in which a gtest or rostest program has left its test cases."""
    if program["kind"] == "gtest":
        return [results / f"gtest-{program['name']}.xml"]
    name = program["name"].rsplit(".", 1)[0]
    overview = read_xml(results / f"rostest-{name}.xml")
    if overview is None:
        return []
    # rostest reports on each <test test-name="x"> as "testx"; x itself writes rosunit-x.xml.
    inner = [case.get("name")[len("test"):] for case in overview.iter("testcase")]
    return [results / f"rosunit-{test_name}.xml" for test_name in inner]


def count_cases(path, count, failed, reasons):
    """Adds the cases in one result file of gtest; how many there were."""
    root = read_xml(path)
    cases = list(root.iter("testcase")) if root is not None else []
    for case in cases:
        skipped = case.find("skipped")
        if case.find("failure") is not None or case.find("error") is not None:
            count["failed"] += 1
            failed.append(f"{case.get('classname')}.{case.get('name')}")
        elif skipped is not None:
            count["skipped"] += 1
            reason = (skipped.get("message") or "").split("\n", 1)[-1].strip()
            reasons[reason or "no reason given"] += 1
        elif case.get("status") == "notrun":
            count["skipped"] += 1
            reasons["disabled"] += 1
        else:
            count["passed"] += 1
    return len(cases)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("registered", type=pathlib.Path, help="what ctest --show-only=json-v1 said")
    parser.add_argument("report", type=pathlib.Path, help="what ctest --output-junit wrote")
    parser.add_argument("results", type=pathlib.Path, help="the package's folder of test results")
    arguments = parser.parse_args()

    registered = [test["name"] for test in json.loads(arguments.registered.read_text())["tests"]]
    report = read_xml(arguments.report)
    entries = report.iter("testcase") if report is not None else []
    status = {entry.get("name"): entry.get("status") for entry in entries}

    count = collections.Counter()
    failed = []
    reasons = collections.Counter()
    if not any(map(PROGRAM.fullmatch, registered)):
        count["failed"] += 1
        failed.append("no gtest and no rostest is registered")
    for name in registered:
        succeeded = status.get(name) == "run"
        program = PROGRAM.fullmatch(name)
        if not program:
            count["passed" if succeeded else "failed"] += 1
            failed += [] if succeeded else [name]
            continue
        failed_before = count["failed"]
        files = result_files(arguments.results, program)
        cases = sum(count_cases(path, count, failed, reasons) for path in files)
        if count["failed"] == failed_before and (cases == 0 or not succeeded):
            count["failed"] += 1
            failed.append(name + (": is empty" if succeeded else ": crashed, hung or did not run"))

    for reason, cases in sorted(reasons.items()):
        print(f"skipped {cases}: {reason}")
    for name in failed:
        print(f"failed: {name}")
    closing = f"{count['passed']} passed, {count['failed']} failed"
    print(closing + (f", {count['skipped']} skipped" if count["skipped"] else ""))
    return 1 if count["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
