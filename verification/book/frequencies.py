"""Natural frequencies: of the compliant four-bar and of cantilevers."""

import math

import measure
import runs
from measure import Sweep, beam_sweep, convergence, exact_sweep, relative
from pages import Page, scientific, share, times
from pictures import picture
from runs import modeling

FRAME = "examples/compliant_four_bar_dynamics.toml"


def frequencies(run):
    return run.summary["angular_frequencies"]


def worst_frequency(run, truth):
    return max(relative(a, b) for a, b in zip(frequencies(run), truth))


def frequency_table(page, found, truth):
    basis = found["exact"].summary["seconds"]
    rows = []
    for label, run in found.items():
        values = frequencies(run)
        rows.append([f"`{label}`"] + [share(values[k] / truth[k] - 1) if k < len(values) else "–"
                                      for k in range(6)]
                    + [run.summary["unknowns"], times(run.summary["seconds"] / basis)])
    page.table(["modeling", *(f"mode {k}" for k in range(1, 7)), "unknowns", "cost by `exact`"],
               rows)


def frequency_modelings():
    return [modeling("linear"), modeling("scmbm"), modeling("prbm"), modeling("bcm"),
            modeling("bcm", "bcm_8", elements=8),
            modeling("beam", "timoshenko", theory="timoshenko", elements=8),
            modeling("beam", "von_karman", theory="von_karman", elements=8),
            modeling("beam", elements=16),
            modeling("beam", "beam_order_4", elements=8, order=4),
            modeling("exact", "exact_no_shear", shear=False), modeling("exact"),
            modeling("continuum")]


def frame_frequencies(flexura):
    page = Page("frame_frequencies", "Frequencies of the compliant four-bar", [FRAME])
    model = runs.load_model(FRAME)
    reference = runs.reference_json("dynamics/case4_frame_frequencies.json")
    truth = reference["Timoshenko_rotary_unloaded"]
    study = runs.study(model, "frequencies", modelings=frequency_modelings(), reference="exact")
    found = flexura.run(model, study)
    page.text("""The frame of [the compliant four-bar](compliant_four_bar.md), of polypropylene,
    vibrates about its drawn state and about its equilibrium under 0.28 N.""")
    page.figure("picture", "The frame", picture(model))
    page.section("Source and reference")
    page.text("""The first source's frame. Reference:
    [independent     solutions](../../tests/data/reference/dynamics/README.md): the exact dynamic
    stiffness of Euler and Bernoulli's beams (1e-9), and geometrically exact beams with shear and
    rotary inertia, cubic elements, extrapolated (1e-7).""")
    page.table(["angular frequency, rad/s", *(f"mode {k}" for k in range(1, 7))],
               [["with shear and rotary inertia"] + [f"{w:.5f}" for w in truth],
                ["`exact`"] + [f"{w:.5f}" for w in frequencies(found["exact"])],
                ["Euler and Bernoulli"]
                + [f"{w:.5f}" for w in reference["EB_exact_dynamic_stiffness"]]])
    page.section("Modelings")
    page.text("How far the frequencies are off, against the theory with shear and rotary inertia.")
    frequency_table(page, found, truth)
    page.promise("six frequencies of the drawn frame", "exact",
                 worst_frequency(found["exact"], truth), 1e-7)
    linear = flexura.run(model, runs.study(model, "frequencies", reference=None, modelings=[
        modeling("exact", "exact", axial=True, shear=False)]))["exact"]
    for k, (a, b) in enumerate(zip(frequencies(linear), frequencies(found["exact"]))):
        page.facts[f"mode {k + 1}"] = [f"{b:.4f}", f"{a:.4f}", f"{25 * (a - b):.2g}"]
    page.promise("six frequencies by Euler and Bernoulli's theory", "exact without shear",
                 worst_frequency(linear, reference["EB_exact_dynamic_stiffness"]), 1e-9)
    path = {"sway": runs.study(model, "sway", modelings=[modeling("exact")])}
    loaded = flexura.run(model, {"kind": "modes", "count": 6, "modelings": [modeling("exact")],
                                 "about": {"study": "sway", "load_factor": 1.0}}, others=path)
    page.promise("six frequencies of the loaded frame", "exact", worst_frequency(
        loaded["exact"], reference["Timoshenko_rotary_loaded_0.28N"]), 1e-7)
    page.text("""Modelings whose shape comes from the ends of a flexure alone (`linear`, `scmbm`,
    `prbm`, `bcm` of one element) have the sway and little more: a leg that vibrates by itself is
    not among what they can do. That Euler and Bernoulli's beam runs ahead is
    [a     finding](findings.md).""")

    def error_of(run):
        return worst_frequency(run, frequencies(fine))

    fine = flexura.run(model, runs.study(model, "frequencies", reference=None, modelings=[
        modeling("exact", modes=20)]))["exact"]
    sweeps = [exact_sweep([4, 5, 6, 7, 8, 10]), beam_sweep(1, [4, 8, 16, 32, 64]),
              beam_sweep(2, [2, 4, 8, 16]), beam_sweep(3, [2, 4, 8]), beam_sweep(5, [1, 2, 4])]
    convergence(page, measure.run_sweeps(flexura, model, study, sweeps, error_of),
                "six frequencies (from 20 modes)", {
                    f"beam order {p}": str(2 * p) for p in (1, 2, 3, 5)})
    return page


HERTZ = {"straight": [8.3552, 52.361, 146.61, 287.30, 474.93, 709.47],
         "curved": [8.4604, 49.038, 142.75, 283.14, 470.47, 704.52]}


TIPS = {"straight": (0.840615, 0.488158), "curved": (0.5747063162, 0.7017392286)}


def abaqus_tips(page, flexura, models):
    page.section("Abaqus's tips under load")
    page.text("""The same bars under a dead force of (-200, 200) N at their ends.""")
    rows = []
    for name, model in models.items():
        row = flexura.run(model, runs.study(model, "push"))["exact"].table()[-1]
        off = math.hypot(row["tip.x"] - TIPS[name][0], row["tip.y"] - TIPS[name][1])
        rows.append([name, f"{TIPS[name][0]:.6f}, {TIPS[name][1]:.6f}",
                     f"{row['tip.x']:.6f}, {row['tip.y']:.6f}", scientific(off)])
        page.promise(f"Abaqus's tip, {name}, in lengths", "exact", off, 2e-5)
    page.table(["bar", "Abaqus, m", "`exact`", "off, m"], rows)
    page.text("""Bending strains reach 0.8 %; strain measures differ by the square of that.""")


def roots(function, step, count):
    found, a = [], step
    while len(found) < count:
        low, high = a, a + step
        if function(low) * function(high) <= 0:
            for _ in range(60):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if function(low) * function(middle) > 0 else (
                    low, middle)
            found.append(0.5 * (low + high))
        a += step
    return found


def huang(w, side=0.01, modulus=210e9, shear=80e9, density=7850.0):
    """Timoshenko's cantilever of length 1 (Huang, J. Appl. Mech. 28 (1961) 579): zero at its
    angular frequencies."""
    i = side * side / 12
    r2, s2 = i, modulus * i / (shear * 5 / 6)
    b = w * math.sqrt(density / (modulus * i))
    root = math.sqrt((r2 - s2) ** 2 + 4 / (b * b))
    p, q = b * math.sqrt((root - r2 - s2) / 2), b * math.sqrt((root + r2 + s2) / 2)
    return (2 / math.cosh(p) + (b * b * (r2 - s2) ** 2 + 2) * math.cos(q)
            - b * (r2 + s2) / math.sqrt(1 - b * b * r2 * s2) * math.tanh(p) * math.sin(q))


def cantilever_frequencies(flexura):
    page = Page("cantilever_frequencies", "Frequencies and tips of cantilevers",
                ["verification/cases/straight_cantilever.toml",
                 "verification/cases/curved_cantilever.toml"])
    straight, curved = (runs.load_model(m) for m in page.models)
    page.text("""A steel bar of 1 m by 10 by 10 mm, clamped at one end, straight or bent to an arc
    of 45 degrees.""")
    page.section("Source and reference")
    page.text("""Closed forms for the straight bar: 1 + cos x cosh x = 0 (Euler and Bernoulli) and
    Huang's frequency equation (J. Appl. Mech. 28 (1961) 579) with shear and rotary inertia.
    Abaqus's frequencies, five digits, from the supplement of a paper on curved tapered beams.""")
    unit = math.sqrt(210e9 * 1e-4 / 12 / 7850)
    bernoulli = [x * x * unit for x in
                 roots(lambda x: 1 / math.cosh(x) + math.cos(x), 0.5, 6)]
    timoshenko = roots(huang, 20.0, 6)
    study = runs.study(straight, "vibrate", modelings=frequency_modelings(), reference="exact")
    found = flexura.run(straight, study)
    page.section("Against Timoshenko's theory")
    frequency_table(page, found, timoshenko)
    page.promise("six frequencies by Timoshenko's theory", "exact",
                 worst_frequency(found["exact"], timoshenko), 1e-9)
    page.section("Against Euler and Bernoulli, and Abaqus")
    settings = {"modelings": [modeling("exact", shear=False)], "rotary_inertia": False}
    slender = flexura.run(straight, runs.study(straight, "vibrate", **settings))["exact"]
    bent = flexura.run(curved, runs.study(curved, "vibrate", **settings))["exact"]
    page.promise("six frequencies by Euler and Bernoulli's theory", "exact without shear",
                 worst_frequency(slender, bernoulli), 1e-9)
    rows = []
    for name, run in (("straight", slender), ("curved", bent)):
        abaqus = [2 * math.pi * f for f in HERTZ[name]]
        rows += [[name, *(f"{w / (2 * math.pi):.3f}" for w in frequencies(run))],
                 ["Abaqus", *(f"{f:g}" for f in HERTZ[name])],
                 ["off", *(scientific(a / b - 1, 2) for a, b in zip(frequencies(run), abaqus))]]
        page.promise(f"Abaqus's frequencies, {name}", "exact without shear",
                     worst_frequency(run, abaqus), 2e-5)
    page.table(["Hz", *(f"mode {k}" for k in range(1, 7))], rows)
    sixth = bernoulli[5] / timoshenko[5] - 1
    page.facts["sixth"] = f"{100 * sixth:.2g} %"
    page.facts["abaqus"] = scientific(worst_frequency(slender, [2 * math.pi * f for f in
                                                                HERTZ["straight"]]), 2)
    page.text(f"""Abaqus's are Euler and Bernoulli's, without rotary inertia: with both effects the
    sixth lies {100 * sixth:.2g} % lower, far more than their digits leave open.""")
    abaqus_tips(page, flexura, {"straight": straight, "curved": curved})
    sweeps = [exact_sweep([4, 6, 8, 10, 12, 16, 20]), beam_sweep(1, [8, 16, 32, 64, 128]),
              beam_sweep(2, [4, 8, 16, 32]), beam_sweep(3, [2, 4, 8, 16]),
              beam_sweep(5, [2, 4, 8]),
              Sweep("timoshenko", [4, 8, 16, 32], lambda n: {
                  "name": "beam", "theory": "timoshenko", "elements": n})]
    convergence(page, measure.run_sweeps(
        flexura, straight, study, sweeps, lambda run: worst_frequency(run, timoshenko)),
        "six frequencies", {f"beam order {p}": str(2 * p) for p in (1, 2, 3, 5)})
    return page
