"""Pages of the book in Markdown, and how their numbers are written."""

import math
import re
import textwrap
from dataclasses import dataclass

ROUNDING = 1e-13  # what two runs on two machines may differ by


def scientific(value, digits=3):
    """An error: three digits, or that there is none."""
    if value is None:
        return ""
    if abs(value) < ROUNDING:
        return "< 1e-13"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def tolerance(value):
    """One that is promised: 1e-9, 1.1e-3."""
    return scientific(value, 2).replace(".0e", "e")


def share(value):
    """An error that may be large: scientific below a thousandth, per cent above."""
    if value is None or math.isnan(value):
        return ""
    if abs(value) < 1e-3:
        return scientific(value)
    return f"{100.0 * value:.3g} %"


def times(ratio):
    """A ratio of costs, to one digit; the sign after it says that it is a timing."""
    if ratio is None:
        return ""
    if ratio >= 9.5:
        size = 10 ** math.floor(math.log10(ratio))
        return f"{int(round(ratio / size) * size):,}×"
    return f"{ratio:.1g}×"


def is_number(cell):
    return re.match(r"[-−<–]?\s?\d|$|none$|stopped$|–$", str(cell)) is not None


def table(head, rows):
    """Columns of numbers to the right, others to the left."""
    right = [k > 0 and all(is_number(row[k]) for row in rows) for k in range(len(head))]
    lines = ["| " + " | ".join(head) + " |",
             "|" + "|".join(" ---: " if r else " --- " for r in right) + "|"]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def filled(words):
    """In lines of 100 columns; those of an item stand under its first word."""
    return textwrap.fill(" ".join(words.split()), 100, break_long_words=False,
                         break_on_hyphens=False,
                         subsequent_indent="  " if words.startswith("- ") else "")


@dataclass
class Promise:
    """What a page says will hold: an error and the tolerance it stays below."""

    what: str
    modeling: str
    error: float
    tolerance: float

    @property
    def kept(self):
        return self.error <= self.tolerance


class Page:
    """One case. Text is given; numbers come from runs."""

    def __init__(self, name, title, models=()):
        self.name, self.title = name, title
        self.models = list(models)
        self.blocks, self.figures, self.promises = [], {}, []
        self.facts = {}  # figures that the page of findings quotes

    def text(self, words):
        """A paragraph, or items that begin with "- "."""
        items = re.split(r"\n\s*(?=- )", words.strip())
        self.blocks.append("\n".join(filled(item) for item in items))

    def section(self, title):
        self.blocks.append(f"## {title}")

    def table(self, head, rows):
        self.blocks.append(table(head, rows))

    def figure(self, name, caption, drawing):
        file = f"{self.name}_{name}.svg"
        self.figures[file] = drawing
        self.blocks.append(f"![{caption}](images/{file})\n\n*{caption}*")

    def promise(self, what, modeling, error, tolerance):
        self.promises.append(Promise(what, modeling, error, tolerance))

    @property
    def tightest(self):
        """The promise that is nearest to being broken."""
        return max(self.promises, key=lambda p: p.error / p.tolerance)

    def verdicts(self):
        if not self.promises:
            return []
        rows = [[p.what, f"`{p.modeling}`", scientific(p.error), tolerance(p.tolerance),
                 "kept" if p.kept else "**broken**"] for p in self.promises]
        return ["## Promised",
                table(["what", "by", "error", "promised", ""], rows)]

    def markdown(self):
        models = ", ".join(f"[`{m}`](../../{m})" for m in self.models)
        head = [f"# {self.title}", "[The verification book](README.md)"
                + (f" · model: {models}" if models else "")]
        return "\n\n".join(head + self.blocks + self.verdicts()) + "\n"
