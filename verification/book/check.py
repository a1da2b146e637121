"""What the continuous checks ask of the book, in seconds: its links lead somewhere, its models are
valid, every test and figure is listed, and two cheap pages come out as they stand."""

import re
import subprocess
import tempfile
from pathlib import Path

import book
import tests_page
from runs import TOP, Flexura

CHEAP = ["roll_up", "circular_hinge"]
NOTHING = 1e-9  # errors below are the business of rounding
LINK = re.compile(r"\]\(([^)#\s]+)[^)]*\)")
NUMBER = re.compile(r"[-−]?\d+(?:\.\d+)?(?:e[-−]?\d+)?")
TIMING = re.compile(r"[\d.,]+×")
CASE = re.compile(r"TEST(?:_P|_F)?\(\s*(\w+)\s*,\s*(\w+)\s*\)")
NOTED = re.compile(r'note_measured\("([^"]+)"\s*,')


def missing_pages(folder):
    text = (folder / "README.md").read_text()
    linked = set(LINK.findall(text))
    for name in [*book.PAGES, "findings", "tests"]:
        if f"{name}.md" not in linked:
            yield f"README.md does not list {name}.md"
    for page in folder.glob("*.md"):
        if page.name != "README.md" and page.name not in linked:
            yield f"{page.name} stands in no index"


def broken_links(folder):
    for page in folder.glob("*.md"):
        for link in LINK.findall(page.read_text()):
            if ":" not in link and not (folder / link).exists():
                yield f"{page.name} links to {link}, which is not there"
    used = "".join(page.read_text() for page in folder.glob("*.md"))
    for image in (folder / "images").iterdir():
        if image.name not in used:
            yield f"images/{image.name} is on no page"


def invalid_models(command):
    for model in sorted((TOP / "verification/cases").glob("*.toml")):
        done = subprocess.run([command, "check", str(model)], capture_output=True, text=True,
                              check=False)
        if done.returncode:
            yield f"{model.name}: {done.stdout}{done.stderr}"


def unlisted_tests(folder):
    """Tests of the sources that the page of tests does not have, and figures noted by a plain
    name. The page is made by `python3 verification/book tests`."""
    text = (folder / "tests.md").read_text().replace("\\", "")
    for source in sorted(tests_page.SOURCES.glob("*.cpp")):
        code = source.read_text()
        for suite, name in CASE.findall(code):
            if not re.search(rf"`(?:\w+/)?{suite}(?:/[^`]*)?\.{name}(?:/[^`]*)?`", text):
                yield f"tests.md lacks {suite}.{name} ({source.name})"
        for figure in NOTED.findall(code):
            if figure not in text:
                yield f"tests.md lacks the figure {figure} ({source.name})"


def numbers(line):
    """Those of a line, as they are written, without timings."""
    return NUMBER.findall(TIMING.sub("", line).replace("−", "-").replace("< 1e-13", "0.0"))


def differ(a, b):
    """Counts (of iterations) by more than 5 % and 2; others by more than one in the last of three
    digits."""
    most = 0.05 if a.isdigit() and b.isdigit() else 1.01e-2
    least = 2.0 if a.isdigit() and b.isdigit() else NOTHING
    a, b = float(a), float(b)
    return abs(a - b) > max(least, most * max(abs(a), abs(b)))


def changed_pages(command, folder):
    flexura = Flexura(command)
    with tempfile.TemporaryDirectory() as fresh:
        for name in CHEAP:
            book.make(flexura, name, Path(fresh))
            old = (folder / f"{name}.md").read_text().splitlines()
            new = (Path(fresh) / f"{name}.md").read_text().splitlines()
            if len(old) != len(new):
                yield f"{name}.md has {len(old)} lines, and now {len(new)}"
            for a, b in zip(old, new):
                before, now = numbers(a), numbers(b)
                if len(before) != len(now) or any(map(differ, before, now)):
                    yield f"{name}.md: {a!r} is now {b!r}"


def check(command, folder=book.FOLDER):
    """Prints what is wrong; the exit status."""
    found = [*missing_pages(folder), *broken_links(folder), *invalid_models(command),
             *unlisted_tests(folder), *changed_pages(command, folder)]
    for fault in found:
        print(fault)
    if found:
        print("`python3 verification/book` makes the book anew, with `tests` behind it the figures "
              "of the tests alone.")
    return 1 if found else 0
