"""The figures that the verification tests record, by test."""

import json
import re
import subprocess
import tempfile
from pathlib import Path

from pages import table
from runs import TOP

STANDARD = {"name", "file", "line", "status", "result", "timestamp", "time", "classname",
            "value_param", "type_param", "failures"}
SOURCES = TOP / "verification"


def recorded(command):
    """Runs all verification tests; the record that they write as JSON."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "record.json"
        subprocess.run([command, "--gtest_brief=1", f"--gtest_output=json:{file}"],
                       capture_output=True, check=False)
        return json.loads(file.read_text())


def source_of(suite):
    """The file that has the tests of a suite, and what its first comment says."""
    name = suite.split("/")[-1]
    for path in sorted(SOURCES.glob("*.cpp")):
        text = path.read_text()
        if re.search(rf"TEST(_P|_F)?\(\s*{re.escape(name)}\s*,", text):
            return path
    return None


def purpose(path):
    """The comment at the head of a file, in one line."""
    words = []
    for line in path.read_text().splitlines():
        if not line.startswith("//"):
            break
        words.append(line.lstrip("/ "))
    return " ".join(words)


def by_file(record):
    files = {}
    for suite in record["testsuites"]:
        path = source_of(suite["name"])
        files.setdefault(path, []).append(suite)
    return files


def figures(test):
    return [f"{key} {value}" for key, value in test.items() if key not in STANDARD]


def escaped(text):
    return text.replace("|", "\\|").replace("*", "\\*").replace("_", "\\_").replace("<", "&lt;")


def markdown(record):
    failed = record["failures"]
    blocks = ["# What the verification tests measured", "[The verification book](README.md)",
              f"{record['tests']} tests, {failed} failed. Every figure is one that a test recorded "
              "as it ran, mostly an error; what it must stay below, and why, stands in the test. A "
              "test without a figure holds a yes or no. The same record comes from "
              "`build/release/verification/flexura_verification --gtest_output=json:figures.json`."]
    for path, suites in sorted(by_file(record).items(), key=lambda item: str(item[0])):
        blocks.append(f"## [{path.name}](../../verification/{path.name})")
        blocks.append(escaped(purpose(path)))
        rows = []
        for suite in suites:
            for test in suite["testsuite"]:
                passed = "passed" if not test.get("failures") else "**failed**"
                noted = "<br>".join(escaped(f) for f in figures(test))
                rows.append([f"`{suite['name']}.{test['name']}`", noted, passed])
        blocks.append(table(["test", "measured", ""], rows))
    return "\n\n".join(blocks) + "\n"
