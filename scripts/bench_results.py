"""Reads what cloth_bench wrote: the runs of each case, their medians and their spread."""

import json
import math
import pathlib
import re
import statistics

# What Google Benchmark adds to a name.
SUFFIXES = re.compile(r"/(iterations|repeats|min_time):[0-9.]+|/(real|manual|process)_time")


class Figure:
    """The repetitions of one measure."""

    def __init__(self, values):
        self.values = sorted(values)

    @property
    def median(self):
        return statistics.median(self.values)

    @property
    def spread(self):
        """Half the range between the quartiles, as a part of the median; 0 for a single value."""
        if len(self.values) < 2 or self.median == 0:
            return 0.0
        low, _, high = statistics.quantiles(self.values, n=4, method="inclusive")
        return abs((high - low) / 2.0 / self.median)


class Results:
    """All cases in the JSON files of a folder, by name."""

    def __init__(self, folder):
        self.context = {}
        self.errors = {}
        self._runs = {}
        for path in sorted(pathlib.Path(folder).glob("*.json")):
            try:
                content = json.loads(path.read_text(encoding="utf-8"))
            except ValueError as error:
                raise ValueError(f"{path} is no complete JSON: {error}") from None
            self.context.update(content.get("context", {}))
            for run in content.get("benchmarks", []):
                self._add(run)
        if not self._runs:
            raise ValueError(f"{folder} has no results of cloth_bench")

    def _add(self, run):
        name = SUFFIXES.sub("", run["name"])
        if run.get("run_type") != "iteration":
            return
        if run.get("error_occurred"):
            self.errors[name] = run.get("error_message", "failed")
            return
        self._runs.setdefault(name, []).append(run)

    def names(self):
        return list(self._runs)

    def figure(self, name, measure):
        """None if the case was not run, or has no such measure."""
        values = [run[measure] for run in self._runs.get(name, []) if measure in run]
        values = [value for value in values if math.isfinite(value)]
        return Figure(values) if values else None

    def median(self, name, measure):
        """nan if there is none."""
        figure = self.figure(name, measure)
        return figure.median if figure else math.nan


def step_case(engine, scene="hung", mesh="grid", side=30, threads=1):
    return f"step/{engine}/{scene}/{mesh}/{side}/threads:{threads}"


def torn_case(engine, mesh="grid", side=30):
    return f"torn/{engine}/{mesh}/{side}/threads:1"
