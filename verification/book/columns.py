"""Buckling of columns: Euler's loads and Haringx'."""

import copy
import math

import measure
import runs
from measure import TWICE, beam_sweep, convergence, exact_sweep, relative
from pages import Page, scientific, share, times
from pictures import picture
from runs import modeling

RIGID = {"axial": False, "shear": False}


def euler_loads():
    """Of the four columns together, EI = L = 1, ascending."""
    low, high = math.pi + 0.1, 1.5 * math.pi - 1e-9
    for _ in range(200):  # tan x = x
        x = 0.5 * (low + high)
        low, high = (x, high) if math.tan(x) < x else (low, x)
    pi2 = math.pi**2
    return [("free", pi2 / 4), ("pinned", pi2), ("propped", low * low),
            ("free, second", 9 * pi2 / 4), ("clamped", 4 * pi2), ("pinned, second", 4 * pi2)]


def lying(model):
    """The same columns drawn along x."""
    turned = copy.deepcopy(model)
    for flexure in turned["flexures"].values():
        flexure["axis"]["line"] = [[y, x] for x, y in flexure["axis"]["line"]]
    for joint in turned["joints"].values():
        joint["prismatic"]["direction"] = [1, 0]
    for study in turned["studies"].values():
        for load in study["loads"]:
            load["force"] = load["force"][::-1]
    return turned


def free_alone(model):
    """The free column without the others."""
    alone = {key: value for key, value in model.items() if key != "joints"}
    alone["bodies"] = {n: b for n, b in model["bodies"].items() if n in ("ground", "free_top")}
    alone["flexures"] = {"free": model["flexures"]["free"]}
    return alone


def worst_of(run):
    return max(relative(a, b) for a, (_, b) in zip(run.summary["load_factors"], euler_loads()))


def columns(flexura):
    page = Page("columns", "Buckling of columns", ["verification/cases/columns.toml"])
    model = runs.load_model(page.models[0])
    page.text("""Four columns, clamped at the foot or pinned, stand side by side; their tops are
    free, pinned, propped and clamped in guides, each under a dead axial load. One study finds the
    buckling loads of all of them in ascending order, a double one among them.""")
    page.figure("picture", "Free, pinned, propped, clamped",
                picture(model, None, model["studies"]["buckle"]["loads"]))
    page.section("Source and reference")
    page.text("""Euler's loads, EI = L = 1: π²/4, π², the square of the least root of tan x = x,
    9π²/4, and 4π² twice. With axial and shear strain the free column gives way at
    P (1 − P/EA + P/GA_s) = π²/4 (Haringx); EA = 400, GA_s = 150.""")
    page.section("Euler's loads")
    chosen = [modeling("prbm"), modeling("beam", **RIGID),
              modeling("beam", "beam_order_4", elements=8, order=4, **RIGID),
              modeling("exact", **RIGID)]
    study = runs.study(model, "buckle", modelings=chosen)
    found = flexura.run(model, study)
    linear = flexura.run(model, {**study, "linearised": True})
    rows = []
    for k, (name, load) in enumerate(euler_loads()):
        values = [run.summary["load_factors"] for run in found.values()]
        values.append(linear["exact"].summary["load_factors"])
        rows.append([name, f"{load:.9f}"] + [
            share(relative(v[k], load)) if k < len(v) else "" for v in values])
    page.table(["column", "load"] + [f"`{label}`" for label in found]
               + ["`exact`, `linearised = true`"], rows)
    page.text("""`prbm` has three springs a column: its first loads are good to some per cent, and
    then it runs out of ways to bend. `linear` never buckles.""")
    page.promise("six Euler loads, linearised", "exact", worst_of(linear["exact"]), 1e-8)
    directions(page, flexura, model)
    haringx(page, flexura, model)
    return page


def directions(page, flexura, model):
    page.section("Along y, and along x")
    tolerances = [1e-6, 1e-8, 1e-10, 1e-12]
    chosen = [modeling("exact", f"exact_{t:g}", tolerance=t, **RIGID) for t in tolerances]
    rows, results = [], {}
    for name, drawn in (("along y", model), ("along x", lying(model))):
        found = flexura.run(drawn, runs.study(drawn, "buckle", modelings=chosen))
        results[name] = found
        for label, run in found.items():
            rows.append([f"{name}, `{label}`", scientific(worst_of(run)),
                         scientific(run.summary["error_estimate"])])
    page.table(["drawn, tolerance", "largest error of six", "its own estimate"], rows)
    page.promise("six Euler loads, bifurcations along the path, drawn along x", "exact",
                 worst_of(results["along x"]["exact_1e-12"]), 1e-11)
    page.promise("six Euler loads along the path, drawn along y", "exact",
                 max(worst_of(run) for run in results["along y"].values()), 1e-6)
    page.text("""cos 90° is 6e-17 in the computer, so that a column along y is bent by as little,
    and its bifurcation is a narrow miss beside which no step converges. The load is narrowed down
    there by the count of unstable directions between states on both sides.""")


def haringx(page, flexura, model):
    page.section("With axial and shear strain")
    euler, c = math.pi**2 / 4, 1 / 150 - 1 / 400
    truth = (math.sqrt(1 + 4 * c * euler) - 1) / (2 * c)
    drawn = lying(model)
    study = runs.study(drawn, "soft")

    def error_of(run):
        loads = run.summary["load_factors"]
        return relative(loads[0], truth) if loads else math.nan

    chosen = [modeling("bcm"), modeling("bcm", "bcm_8", elements=8), modeling("prbm"),
              modeling("beam", "von_karman", theory="von_karman"), modeling("beam"),
              modeling("exact")]
    found = flexura.run(drawn, {**study, "modelings": chosen})
    page.text(f"""The free column, drawn along x, gives way at {truth:.9f}, of which Euler's
    theory is {100 * (euler / truth - 1):.2g} % too high.""")
    basis = found["exact"].summary["seconds"]
    page.table(["modeling", "load", "error", "unknowns", "cost by `exact`"],
               [[f"`{label}`", f"{run.summary['load_factors'][0]:.9f}", share(error_of(run)),
                 run.summary["unknowns"], times(run.summary["seconds"] / basis)]
                for label, run in found.items()])
    page.promise("Haringx' load of the soft column", "exact", error_of(found["exact"]), 1e-8)
    fine = flexura.run(free_alone(drawn), {**study, "modelings": [
        modeling("beam", f"von_karman_{n}", theory="von_karman", elements=n)
        for n in (16, 32, 64, 96)]})
    page.table(["`von_karman`", "load", "from Haringx"],
               [[label.split("_")[-1] + " elements"]
                + ([f"{run.summary['load_factors'][0]:.9f}", share(error_of(run))]
                   if run.summary["load_factors"] else ["none", run.summary["reason"]])
                for label, run in fine.items()])
    page.text("""`bcm` has no shear, `prbm` neither that nor axial strain. `von_karman` tends to a
    load of its own: its shear is not Haringx'.""")
    sweeps = [exact_sweep([2, 3, 4, 5, 6]), beam_sweep(1, [2, 4, 8, 16, 32]),
              beam_sweep(2, [1, 2, 4, 8]), beam_sweep(3, [1, 2, 4])]
    convergence(page, measure.run_sweeps(flexura, drawn, study, sweeps, error_of),
                "Haringx' load", TWICE)
