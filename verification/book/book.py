"""The list of pages, and the book written to docs/verification."""

import os
import platform
import time

import cantilevers
import chain
import columns
import findings
import frames
import frequencies
import linkages
import motion
import pivots
import slider_crank
import solids
import stability
import tests_page
from pages import scientific, table, tolerance
from runs import TOP, Flexura

FOLDER = TOP / "docs/verification"
PAGES = {
    "arc_chain": chain.arc_chain,
    "compliant_four_bar": frames.four_bar,
    "printed_elements": frames.printed_elements,
    "tip_load": cantilevers.tip_load,
    "roll_up": cantilevers.roll_up,
    "cross_spring": pivots.cross_spring,
    "parallelogram": pivots.parallelogram,
    "circular_hinge": pivots.circular_hinge,
    "lee_frame": stability.lee_frame,
    "snap_through": stability.arch_and_toggle,
    "columns": columns.columns,
    "thick_ring": solids.thick_ring,
    "cantilever_frequencies": frequencies.cantilever_frequencies,
    "frame_frequencies": frequencies.frame_frequencies,
    "frame_history": motion.frame_history,
    "spin_up": motion.spin_up,
    "slider_crank": slider_crank.slider_crank,
    "turcic_midha": linkages.turcic_midha,
}

INTRODUCTION = """# The verification book

Flexura against truth from outside: closed forms, published values, and solutions that another
method found ([static](../../tests/data/reference/static/README.md),
[in motion](../../tests/data/reference/dynamics/README.md)). A page per case has the problem, its
source, every modeling that applies beside the reference, and how errors fall as meshes get finer.
Every number comes from a run; text says what it is and why it is so.

    python3 verification/book

makes the whole book anew, in three minutes or so of an idle machine, from a release build
(`build/release`); names of pages after it make those alone, `tests` the figures of the tests. It
needs Python 3.11 and nothing else. A second run on the same machine changes nothing but timings,
which all carry the sign ×. `--check` takes seconds and is the test `VerificationBook`."""

AFTER_TABLE = """One row per case: the promise that is nearest to being broken, by the best
modeling; its page has them all. Where a test makes the same comparison, the promise is the test's.
The book's command fails where one is broken."""

READING = """## How to read it

- **Errors** are relative where nothing else is said: the largest distance of a place from the
  reference over all states, by its largest displacement. Below 1e-13 rounding has the word.
- **Its own estimate** is what Flexura says of its discretization error, without the reference.
- **Cost** is the time of a path, with that estimate, as a multiple of `exact`'s in the same run, to
  one digit; such times scatter by a factor of two or so. Machine: {machine}.
- **Orders** count elements: an error that falls as h^p has order p."""


def machine():
    """The processor's name and how many there are."""
    name = platform.processor()
    if os.path.exists("/proc/cpuinfo"):
        with open("/proc/cpuinfo") as file:
            names = [line.split(":", 1)[1].strip() for line in file if "model name" in line]
        name = names[0] if names else name
    return f"{name or 'unknown processor'}, {os.cpu_count()} of them"


def summary_rows(pages):
    rows = []
    for page in pages.values():
        kept = sum(p.kept for p in page.promises)
        worst = page.tightest
        verdict = "kept" if kept == len(page.promises) else "**broken**"
        rows.append([f"[{page.title}]({page.name}.md)", worst.what, f"`{worst.modeling}`",
                     scientific(worst.error), tolerance(worst.tolerance),
                     f"{verdict}, {kept} of {len(page.promises)}"])
    return rows


def index(pages, record):
    figures = sum(len(tests_page.figures(t)) for s in record["testsuites"]
                  for t in s["testsuite"])
    failed = record["failures"]
    tests = (f"## Tests\n\n[What the verification tests measured](tests.md): {record['tests']} "
             f"tests, {figures} figures, {failed} failed, by file and test.")
    found = ("## Findings\n\n[Findings on the sources](findings.md): what three sources print, "
             "what of it holds, and where Flexura itself falls short.")
    rows = table(["case", "promise", "by", "error", "promised", "verdict"], summary_rows(pages))
    return "\n\n".join([INTRODUCTION, "## Cases", rows, AFTER_TABLE, found, tests,
                        READING.format(machine=machine())]) + "\n"


def write_page(page, folder=FOLDER):
    (folder / "images").mkdir(parents=True, exist_ok=True)
    for file, drawing in page.figures.items():
        (folder / "images" / file).write_text(drawing)
    (folder / f"{page.name}.md").write_text(page.markdown())


def make(flexura, name, folder=FOLDER):
    started = time.monotonic()
    page = PAGES[name](flexura)
    write_page(page, folder)
    print(f"{name}: {time.monotonic() - started:.1f} s", flush=True)
    for promise in page.promises:
        if not promise.kept:
            print(f"  broken: {promise.what}: {promise.error:.3g} > {promise.tolerance:g}")
    return page


def write(command, tests, names):
    """Makes the pages of these names, or all and the index; whether every promise was kept."""
    flexura = Flexura(command)
    pages = {name: make(flexura, name) for name in names or PAGES if name != "tests"}
    record = None
    if not names or "tests" in names:
        record = tests_page.recorded(tests)
        (FOLDER / "tests.md").write_text(tests_page.markdown(record))
    if not names:
        write_page(findings.findings(flexura, pages, record))
        (FOLDER / "README.md").write_text(index(pages, record))
    return all(p.kept for page in pages.values() for p in page.promises)
