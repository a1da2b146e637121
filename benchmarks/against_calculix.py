#!/usr/bin/env python3
"""Times CalculiX (command ccx, Debian package calculix-ccx) and Flexura on the arc chain of
examples/arc_chain.toml, load case LC1 (+), plane stress. What it compares, how fair
that is and what it gave is in docs/continuum.md, "Against CalculiX".

    benchmarks/against_calculix.py same --across 20 --steps 2     # one mesh, one load step's cost
    benchmarks/against_calculix.py accuracy                       # cost of one accuracy

Python 3 and its standard library only. Optional: nothing else needs ccx.
"""

import argparse
import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
THICKNESS = 0.1  # mm
YOUNG, POISSON = 2100.0, 0.35  # N/mm^2
FORCE = 1e-3  # N along x at E
LOAD_STEPS = 20
POINT_E = (19.093, 15.750)
BODY_WIDTH, BODY_DEPTH, BODY_COLUMNS = 1.0, 1.5, 4  # of a stiff body's blocks
# Residuals below 1e-6 count as zero in CalculiX: its unit of force is 1e-6 N.
FORCE_UNIT = 1e6


@dataclass
class Arc:
    centre: tuple
    radius: float
    start: float
    sweep: float

    @property
    def length(self):
        return self.radius * abs(self.sweep)

    def at(self, share):
        """Place, tangent and normal where this share of the arc length is behind."""
        angle = self.start + share * self.sweep
        radial = (math.cos(angle), math.sin(angle))
        sign = math.copysign(1.0, self.sweep)
        place = tuple(c + self.radius * r for c, r in zip(self.centre, radial))
        return place, (-sign * radial[1], sign * radial[0]), (-sign * radial[0], -sign * radial[1])


ARCS = [
    Arc((0.0, 3.0), 3.0, -math.pi / 2, -4 * math.pi / 3),
    Arc((9.093, 8.25), 3.5, -5 * math.pi / 6, 5 * math.pi / 6),
    Arc((12.593, 15.75), 2.5, -math.pi / 2, -3 * math.pi / 2),
]


class Mesh:
    """Four- or eight-node quadrilaterals: blocks of columns between lines of nodes, each `across`
    elements wide. `order` counts the elements' nodes along an edge, less one."""

    def __init__(self, order, across):
        self.order, self.across = order, across
        self.rows = order * across + 1
        self.nodes = []
        self.elements = {"flexures": [], "bodies": []}

    def line(self, place, normal, width, inner=False):
        """A line of nodes; on inner lines of eight-node elements only their corners' rows."""
        numbers = []
        for row in range(self.rows):
            if inner and row % 2:
                numbers.append(None)
                continue
            eta = width * (row / (self.rows - 1) - 0.5)
            self.nodes.append((place[0] + eta * normal[0], place[1] + eta * normal[1]))
            numbers.append(len(self.nodes))
        return numbers

    def fill(self, kind, lines):
        for base in range(0, len(lines) - 1, self.order):
            for row in range(0, self.rows - 1, self.order):
                self.elements[kind].append(self.element(lines[base : base + self.order + 1], row))

    def element(self, lines, row):
        o = self.order
        corners = [lines[0][row], lines[o][row], lines[o][row + o], lines[0][row + o]]
        middles = []
        if o == 2:
            middles = [lines[1][row], lines[2][row + 1], lines[1][row + 2], lines[0][row + 1]]
        places = [self.nodes[n - 1] for n in corners]
        area = sum(
            a[0] * b[1] - a[1] * b[0] for a, b in zip(places, places[1:] + places[:1])
        )
        if area > 0.0:
            return corners + middles
        return corners[::-1] + [middles[i] for i in (2, 1, 0, 3) if middles]

    def between(self, kind, first, last, columns):
        """A block between two lines of nodes, by straight lines."""
        n = columns * self.order
        lines = [first]
        for k in range(1, n):
            inner, share = self.order == 2 and k % 2, k / n
            numbers = []
            for row in range(self.rows):
                if inner and row % 2:
                    numbers.append(None)
                    continue
                a, b = self.nodes[first[row] - 1], self.nodes[last[row] - 1]
                self.nodes.append(tuple(p + share * (q - p) for p, q in zip(a, b)))
                numbers.append(len(self.nodes))
            lines.append(numbers)
        self.fill(kind, lines + [last])

    def flexure(self, arc, along):
        """Nodes evenly spaced along and across, as Flexura places those of `elements`."""
        n = along * self.order
        lines = []
        for k in range(n + 1):
            place, _, normal = arc.at(k / n)
            lines.append(self.line(place, normal, THICKNESS, self.order == 2 and k % 2))
        self.fill("flexures", lines)
        return lines[0], lines[-1]

    def distance(self, a, b):
        return math.dist(self.nodes[a - 1], self.nodes[b - 1])

    def flare(self, face, arc, share, outward):
        """From a flexure's end face to a wide line in the body."""
        place, tangent, normal = arc.at(share)
        far = tuple(p + outward * BODY_DEPTH * t for p, t in zip(place, tangent))
        wide = self.line(far, normal, BODY_WIDTH)
        self.between("bodies", face, wide, BODY_COLUMNS)
        return wide

    def join(self, first, last):
        """The way round that does not cross; sheets may lie upon each other."""
        straight = self.distance(first[0], last[0]) + self.distance(first[-1], last[-1])
        crossed = self.distance(first[0], last[-1]) + self.distance(first[-1], last[0])
        self.between("bodies", first, last if straight < crossed else last[::-1], BODY_COLUMNS)


def make_mesh(order, across, along):
    """The chain, its base face and the node at E."""
    mesh = Mesh(order, across)
    ends = [mesh.flexure(arc, along) for arc in ARCS]
    for i, arc in enumerate(ARCS):
        wide = mesh.flare(ends[i][1], arc, 1.0, 1.0)
        if i + 1 < len(ARCS):
            mesh.join(wide, mesh.flare(ends[i + 1][0], ARCS[i + 1], 0.0, -1.0))
    tip = mesh.line((POINT_E[0], POINT_E[1] - BODY_WIDTH / 2), (0.0, 1.0), BODY_WIDTH)
    mesh.join(wide, tip)
    return mesh, ends[0][0], tip[-1]


def number(x):
    """CalculiX cuts numbers at 20 characters."""
    text = f"{x:.13g}"
    return text if len(text) <= 20 else f"{x:.11e}"


def write_calculix(path, mesh, base, at_e, case):
    kind = {1: case.element, 2: "CPS8R"}[mesh.order]
    load = FORCE * FORCE_UNIT * case.slice * case.steps / LOAD_STEPS
    with open(path, "w", encoding="ascii") as out:
        out.write("*NODE,NSET=ALL\n")
        for i, (x, y) in enumerate(mesh.nodes, 1):
            out.write(f"{i},{number(x)},{number(y)},0.\n")
        count = 0
        for name, elements in mesh.elements.items():
            out.write(f"*ELEMENT,TYPE={kind},ELSET={name}\n")
            for nodes in elements:
                count += 1
                out.write(f"{count},{','.join(map(str, nodes))}\n")
        out.write("*NSET,NSET=BASE\n" + ",\n".join(map(str, base)) + "\n")
        out.write(f"*NSET,NSET=E\n{at_e}\n")
        for name, factor in (("flexures", 1.0), ("bodies", case.body_stiffness)):
            out.write(f"*MATERIAL,NAME={name}\n*ELASTIC\n")
            out.write(f"{number(YOUNG * FORCE_UNIT * factor)},{POISSON}\n")
            out.write(f"*SOLID SECTION,ELSET={name},MATERIAL={name}\n{case.slice}\n")
        out.write("*BOUNDARY\nBASE,1,2\n")
        out.write(f"*STEP,NLGEOM,INC=100000\n*STATIC{',DIRECT' if case.direct else ''}\n")
        step = 1.0 / case.steps
        out.write(f"{number(step)},1.,1e-6,{number(step)}\n")
        # Iterations before it looks for divergence, and before it gives up
        out.write("*CONTROLS,PARAMETERS=TIME INCREMENTATION\n")
        out.write("60,80,90,100,60,4,,8,,\n0.5,0.5,0.75,0.85,,,1.5,\n")
        out.write("*CONTROLS,PARAMETERS=FIELD\n")
        out.write(f"{case.residual},1.,,,{case.residual},1e-9\n")
        out.write(f"*CLOAD\n{at_e},1,{number(load)}\n")
        out.write("*NODE PRINT,NSET=E,FREQUENCY=1\nU\n*END STEP\n")


@dataclass
class Case:
    steps: int
    body_stiffness: float = 100.0  # of Young's modulus, over that of the flexures
    slice: float = 0.005  # mm, that plane-stress elements are expanded to
    residual: float = 1e-4  # largest residual over the average force
    element: str = "CPS4"
    direct: bool = False


@dataclass
class Outcome:
    code: str
    what: str
    elements: int = 0
    unknowns: int = 0
    increments: int = 0
    iterations: int = 0
    seconds: float = 0.0
    processor: float = 0.0  # seconds, of all threads: what other work on the machine adds least to
    megabytes: float = 0.0
    place: tuple = (math.nan, math.nan)
    note: str = ""


def measured(command, folder, outcome, threads):
    """Runs a command and measures it as a user would: by the clock on the wall."""
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads))
    output = Path(folder) / "output.txt"
    with open(output, "w", encoding="utf-8") as out:
        start = time.monotonic()
        process = subprocess.Popen(
            command, cwd=folder, env=environment, stdout=out, stderr=subprocess.STDOUT
        )
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            raise
        process.returncode = os.waitstatus_to_exitcode(status)
        outcome.seconds = time.monotonic() - start
    outcome.processor = usage.ru_utime + usage.ru_stime
    outcome.megabytes = usage.ru_maxrss / 1024.0
    if process.returncode != 0:
        outcome.note = f"status {process.returncode}"
    return output.read_text(encoding="utf-8", errors="replace")


def run_calculix(order, across, along, case, options):
    what = f"{'CPS8R' if order == 2 else case.element}, {across} across, {along} along"
    outcome = Outcome("CalculiX", what)
    with tempfile.TemporaryDirectory(dir=options.work) as folder:
        mesh, base, at_e = make_mesh(order, across, along)
        write_calculix(Path(folder) / "chain.inp", mesh, base, at_e, case)
        outcome.elements = sum(map(len, mesh.elements.values()))
        text = measured([options.ccx, "-i", "chain"], folder, outcome, options.threads)
        if options.keep:
            shutil.copytree(folder, options.keep, dirs_exist_ok=True)
        found = re.search(r"number of equations\s+(\d+)", text)
        outcome.unknowns = int(found.group(1)) if found else 0
        outcome.iterations = len(re.findall(r"^ iteration \d+", text, re.M))
        outcome.increments = len(re.findall(r"^ convergence", text, re.M))
        dat = Path(folder) / "chain.dat"
        rows = re.findall(r"^\s+%d\s+(\S+)\s+(\S+)\s+(\S+)\s*$" % at_e,
                          dat.read_text() if dat.exists() else "", re.M)
        if rows and "Job finished" in text and "*ERROR" not in text:
            outcome.place = (POINT_E[0] + float(rows[-1][0]), POINT_E[1] + float(rows[-1][1]))
        else:
            outcome.note = (outcome.note + " stopped").strip()
    return outcome


def flexura_elements(settings):
    """0 where Flexura chooses the mesh itself."""
    counts = dict(re.findall(r"(\w+) = (\d+)", settings))
    return len(ARCS) * int(counts.get("elements", 0)) * int(counts.get("across", 1))


def run_flexura(settings, steps, options):
    outcome = Outcome("Flexura", settings)
    force = FORCE * steps / LOAD_STEPS
    text = (ROOT / "examples/arc_chain.toml").read_text(encoding="utf-8").split("[studies.")[0]
    text += f"""[studies.lc1]
kind = "path"
steps = {steps}
loads = [{{ on = "link4.E", force = [{force!r}, 0.0] }}]
modelings = [{{ name = "continuum", {settings} }}]
"""
    with tempfile.TemporaryDirectory(dir=options.work) as folder:
        (Path(folder) / "chain.toml").write_text(text, encoding="utf-8")
        printed = measured([options.flexura, "run", "chain.toml"], folder, outcome, options.threads)
        results = Path(folder) / "chain.results"
        if not (results / "summary.json").exists():
            outcome.note = printed.strip().splitlines()[-1] if printed.strip() else outcome.note
            return outcome
        outcome.elements = flexura_elements(settings)
        summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
        path = next(iter(summary["studies"]["lc1"]["modelings"].values()))
        outcome.unknowns, outcome.iterations = path["unknowns"], path["iterations"]
        outcome.increments = path["steps"]
        estimate = path["error_estimate"]
        outcome.note = f"path {path['seconds']:.2f} s, own estimate " + (
            f"{estimate:.1e}" if estimate is not None else "none"
        )
        if path["status"] != "converged":
            outcome.note += ", stopped"
        with open(results / "lc1/continuum.csv", newline="", encoding="utf-8") as rows:
            last = list(csv.DictReader(rows))[-1]
        outcome.place = (float(last["link4.E.x"]), float(last["link4.E.y"]))
    return outcome


def displacement(place):
    return math.dist(place, POINT_E)


def print_table(outcomes, reference, against):
    print(f"\nE of the converged solution: {reference[0]:.6f}, {reference[1]:.6f}")
    print("Errors: of the place of E, relative to how far it moves. Ratios: of wall seconds, over")
    print(f"{against.code}'s {against.what}.")
    titles = ("code", "elements", "unknowns", "steps", "iterations", "a step", "wall s", "s a step",
              "CPU s", "MB", "error of E", "ratio", "E.x", "E.y", "what")
    rows = [titles]
    for o in outcomes:
        error = math.dist(o.place, reference) / displacement(reference)
        steps = max(o.increments, 1)
        rows.append((
            o.code, str(o.elements or "own"), str(o.unknowns), str(o.increments),
            str(o.iterations), f"{o.iterations / steps:.1f}", f"{o.seconds:.2f}",
            f"{o.seconds / steps:.3f}", f"{o.processor:.2f}", f"{o.megabytes:.0f}", f"{error:.1e}",
            f"{o.seconds / against.seconds:.1f}", f"{o.place[0]:.6f}", f"{o.place[1]:.6f}",
            o.what + (f" ({o.note})" if o.note else "")))
    widths = [max(len(row[i]) for row in rows) for i in range(len(titles))]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())


def report(run, *arguments):
    outcome = run(*arguments)
    print(f"{outcome.code}: {outcome.what}: {outcome.seconds:.2f} s, {outcome.iterations} "
          f"iterations, E {outcome.place[0]:.6f} {outcome.place[1]:.6f} {outcome.note}".rstrip(),
          flush=True)
    return outcome


def same_mesh(options, reference):
    """Four-node elements, the same nodes, the same load steps."""
    across = options.across
    along = options.along or round(2233 * across / 20)
    plain = f"order = 1, across = {across}, elements = {along}, enhanced = false"
    outcomes = [
        report(run_flexura, plain, options.steps, options),
        report(run_flexura, plain.replace("false", "true"), options.steps, options),
        report(run_calculix, 1, across, along, make_case(options), options),
    ]
    print_table(outcomes, reference, outcomes[0])
    apart = math.dist(outcomes[0].place, outcomes[2].place) / displacement(reference)
    print(f"Without enhanced strains Flexura's E is {apart:.1e} from that of CalculiX.")


def accuracy(options, reference):
    """Meshes that either code would choose for itself."""
    outcomes = [report(run_flexura, s, options.steps, options) for s in options.settings or (
        "tolerance = 1e-3", "tolerance = 1e-4", "order = 5, order_across = 2, elements = 10")]
    for mesh in options.meshes or ("2x40", "2x80", "3x60", "4x80"):
        across, along = map(int, mesh.split("x"))
        outcomes.append(report(run_calculix, 2, across, along, make_case(options), options))
    print_table(outcomes, reference, outcomes[0])


def make_case(options):
    return Case(options.steps, options.body_stiffness, options.slice, options.residual,
                direct=options.direct)


def read_options():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("same", "accuracy"))
    parser.add_argument("--across", type=int, default=20, help="elements over the thickness")
    parser.add_argument("--along", type=int, help="elements along (default: nearly square)")
    parser.add_argument("--steps", type=int, default=LOAD_STEPS,
                        help="the first of 20 load steps (default: all)")
    parser.add_argument("--meshes", nargs="+", metavar="AxB",
                        help="CalculiX: elements across x along each flexure (accuracy)")
    parser.add_argument("--settings", nargs="+", help="Flexura: of the continuum (accuracy)")
    parser.add_argument("--body-stiffness", type=float, default=Case.body_stiffness,
                        help="of CalculiX's bodies, over the flexures'")
    parser.add_argument("--slice", type=float, default=Case.slice,
                        help="thickness out of the plane that CalculiX expands to")
    parser.add_argument("--residual", type=float, default=Case.residual,
                        help="CalculiX's largest residual over its average force")
    parser.add_argument("--direct", action="store_true", help="CalculiX never cuts a load step")
    parser.add_argument("--threads", type=int, default=2, help="of CalculiX (OMP_NUM_THREADS)")
    parser.add_argument("--flexura", default=str(ROOT / "build/release/flexura"))
    parser.add_argument("--ccx", default="ccx")
    parser.add_argument("--work", help="folder for temporary files")
    parser.add_argument("--keep", help="copy CalculiX's last input and output there")
    return parser.parse_args()


def main():
    options = read_options()
    if not 1 <= options.steps <= LOAD_STEPS:
        sys.exit(f"--steps: between 1 and {LOAD_STEPS}")
    for command, hint in ((options.ccx, "install the Debian package calculix-ccx"),
                          (options.flexura, "build the release preset")):
        if not shutil.which(command):
            sys.exit(f"{command} is not there: {hint}. This benchmark is optional.")
    options.flexura = str(Path(shutil.which(options.flexura)).resolve())
    converged = report(run_flexura, "order = 8, order_across = 6, elements = 60", options.steps,
                       options)
    print(f"Load steps: {options.steps} of {LOAD_STEPS}; CalculiX with {options.threads} threads.")
    {"same": same_mesh, "accuracy": accuracy}[options.what](options, converged.place)


if __name__ == "__main__":
    main()
