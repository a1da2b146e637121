"""Runs the command `flexura` on a model and reads what it wrote."""

import copy
import csv
import json
import subprocess
import tempfile
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]


def load_model(path):
    """The model of a file, named from the top of the checkout, as plain tables."""
    with open(TOP / path, "rb") as file:
        return tomllib.load(file)


def inline(value):
    """A value as TOML in one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{quoted(k)} = {inline(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(inline(item) for item in value) + "]"
    if isinstance(value, str):
        return quoted(value)
    return repr(value)


def quoted(text):
    return json.dumps(text)


def study(model, name, **changes):
    """A study of the model with some of its keys replaced; a key that becomes None is left out."""
    changed = {**copy.deepcopy(model["studies"][name]), **changes}
    return {key: value for key, value in changed.items() if value is not None}


def modeling(name, label=None, **settings):
    """An entry of a study's `modelings`."""
    return {"name": name, "label": label or name, **settings}


@dataclass
class Run:
    """What one modeling gave in one study: its entry of summary.json and its tables."""

    label: str
    summary: dict
    folder: Path
    tables: dict = field(default_factory=dict)

    def table(self, kind=""):
        """Rows of `<label>[.kind].csv`, numbers as numbers."""
        if kind not in self.tables:
            name = f"{self.label}.{kind}.csv" if kind else f"{self.label}.csv"
            self.tables[kind] = read_table(self.folder / name)
        return self.tables[kind]

    @property
    def converged(self):
        return self.summary["status"] == "converged"


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def read_table(path):
    with open(path, newline="") as file:
        return [{key: number(value) for key, value in row.items()}
                for row in csv.DictReader(file)]


def reference_table(name, **chosen):
    """Rows of a table of tests/data/reference whose columns have the chosen values."""
    rows = read_table(TOP / "tests/data/reference" / name)
    return [row for row in rows if all(row[key] == value for key, value in chosen.items())]


def reference_json(name):
    return json.loads((TOP / "tests/data/reference" / name).read_text())


class Flexura:
    """The command, and the folders of its runs, which are kept until the end."""

    def __init__(self, command):
        self.command = command
        self.kept = tempfile.TemporaryDirectory(prefix="flexura_book_")
        self.count = 0

    def folder(self, model, studies):
        """The results folder of the model with these studies in place of its own."""
        self.count += 1
        file = Path(self.kept.name) / f"run{self.count}.toml"
        results = file.with_suffix(".results")
        changed = {**model, "studies": studies}
        file.write_text("".join(f"{key} = {inline(value)}\n" for key, value in changed.items()))
        done = subprocess.run([self.command, "run", str(file), "-o", str(results)],
                              capture_output=True, text=True, check=False)
        if done.returncode == 2 or not (results / "summary.json").exists():
            raise RuntimeError(f"{file}: {done.stdout}{done.stderr}")
        return results

    def run(self, model, study_table, repeat=1, others=None):
        """Runs of all modelings of one study, by label. Repeated runs keep the shortest time."""
        name = "case"
        studies = {**(others or {}), name: study_table}
        found = {}
        for _ in range(repeat):
            results = self.folder(model, studies)
            summary = json.loads((results / "summary.json").read_text())["studies"][name]
            for label, entry in summary["modelings"].items():
                if label in found:
                    before = found[label].summary
                    before["seconds"] = min(before["seconds"], entry["seconds"])
                else:
                    found[label] = Run(label, entry, results / name)
        return found
