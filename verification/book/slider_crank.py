"""A slider-crank with a flexible rod, against the small vibrations of a pinned beam."""

import math

import runs
from pages import Page, scientific, share, times
from pictures import picture
from plots import Series, plot
from runs import modeling

CRANK, ROD, THICKNESS = 0.1, 0.4, 0.003
UNIT = math.sqrt(210e9 * THICKNESS**2 / 12 / 7850)
ODD = [k * math.pi for k in (1, 3, 5, 7, 9, 11)]


def turned(t, duration):
    """Crank angle, its rate and its second derivative: one turn by the quintic."""
    x = min(t / duration, 1.0)
    angle = x**3 * (10 - 15 * x + 6 * x * x)
    rate = 30 * x * x * (1 - x) ** 2 / duration
    second = 60 * x * (1 - x) * (1 - 2 * x) / duration**2
    return tuple(2 * math.pi * v for v in (angle, rate, second))


def rigid_rod(t, duration):
    """Of the rigid rod: square of its rate, and what its middle's acceleration across is."""
    a, u, b = turned(t, duration)
    sine = -CRANK / ROD * math.sin(a)
    cosine = math.sqrt(1 - sine * sine)
    rate = -CRANK / ROD * math.cos(a) * u / cosine
    turning = (rate * rate * sine
               - CRANK / ROD * (math.cos(a) * b - math.sin(a) * u * u)) / cosine
    x = CRANK * (-b * math.sin(a) - u * u * math.cos(a))
    y = CRANK * (b * math.cos(a) - u * u * math.sin(a))
    return rate * rate, -sine * x + cosine * y + 0.5 * ROD * turning


def slopes(y, t, duration):
    square, across = rigid_rod(t, duration)
    return y[6:] + [-((k * k / ROD**2 * UNIT) ** 2 - square) * q - 4 / k * across
                    for k, q in zip(ODD, y)]


def ahead(y, h, rate):
    return [a + h * b for a, b in zip(y, rate)]


def small_vibrations(duration, outputs=100, between=250):
    """Deflection at the middle, of six modes of the pinned Euler and Bernoulli beam carried along
    by the rigid mechanism, by the classical method of Runge and Kutta."""
    h = duration / (outputs * between)
    y, found = [0.0] * 12, [0.0]
    for n in range(outputs * between):
        t = n * h
        r1 = slopes(y, t, duration)
        r2 = slopes(ahead(y, h / 2, r1), t + h / 2, duration)
        r3 = slopes(ahead(y, h / 2, r2), t + h / 2, duration)
        r4 = slopes(ahead(y, h, r3), t + h, duration)
        y = [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(y, r1, r2, r3, r4)]
        if (n + 1) % between == 0:
            found.append(y[0] - y[1] + y[2] - y[3] + y[4] - y[5])
    return found


def bending(row, duration):
    """Of the rod's middle, off the line between its pins."""
    a = turned(row["time"], duration)[0]
    pin = CRANK * math.cos(a), CRANK * math.sin(a)
    chord = row["slider.x"] - pin[0], -pin[1]
    middle = (row["rod.mid.x"] - pin[0] - 0.5 * chord[0],
              row["rod.mid.y"] - pin[1] - 0.5 * chord[1])
    return (chord[0] * middle[1] - chord[1] * middle[0]) / math.hypot(*chord)


def bent(run, duration):
    return [bending(row, duration) for row in run.table()]


def apart(found, truth):
    return max(abs(a - b) for a, b in zip(found, truth)) / max(abs(b) for b in truth)


def slider_crank(flexura):
    page = Page("slider_crank", "Slider-crank with a flexible rod",
                ["verification/cases/slider_crank.toml"])
    model = runs.load_model(page.models[0])
    page.text("""A crank of 0.1 m makes one turn, smoothly from rest to rest; the rod, a steel strip
    of 0.4 m by 3 mm, bends under its own inertia. The slider has no mass.""")
    page.figure("picture", "Drawn position; the crank turns about the left", picture(model))
    page.section("Source and reference")
    page.text("""Flexible slider-cranks are a standard test (Viscomi and Ayre 1971; Chu and Pan
    1975) whose published curves and parameters we could not get. Reference: the small vibrations
    of a pinned Euler and Bernoulli beam that the rigid mechanism carries along, six modes,
    integrated on this page by the method of Runge and Kutta. It leaves out the axial force, so it
    is right in the limit of slow turns: an error of second order in the speed.""")
    page.section("Tends to the small vibrations")
    errors, curves = {}, None
    for duration in (0.5, 1.0, 2.0):
        changed = {**model, "parameters": {"duration": duration}}
        run = flexura.run(changed, runs.study(changed, "turn", estimate=False))["exact"]
        truth = small_vibrations(duration)
        found = bent(run, duration)
        errors[duration] = apart(found, truth)
        curves = curves or (duration, found, truth)
    ratio = errors[1.0] / errors[2.0]
    page.table(["one turn in", "deflection, by its largest"],
               [[f"{d:g} s", scientific(off)] for d, off in errors.items()])
    page.text(f"""At half the speed the difference falls by {ratio:.3f}; 4 is what theory says.""")
    page.promise("deflection for a turn in 2 s", "exact", errors[2.0], 5e-4)
    page.promise("ratio of the errors at half the speed, from 4", "exact", abs(ratio - 4), 0.3)
    at = [curves[0] * k / 100 for k in range(101)]
    page.figure("bending", f"Deflection of the rod's middle, one turn in {curves[0]:g} s", plot(
        [Series("small vibrations", [(t, 1e6 * b) for t, b in zip(at, curves[2])], "thick", 0),
         Series("exact", [(t, 1e6 * a) for t, a in zip(at, curves[1])], "line", 1)],
        "time, s", "deflection, µm"))
    modelings(page, flexura, model)
    return page


def modelings(page, flexura, model):
    page.section("Modelings")
    page.text("""One turn in 0.12 s, which shakes the rod at up to a third of its first frequency,
    against `exact` with 12 modes.""")
    duration = 0.12
    changed = {**model, "parameters": {"duration": duration}}
    chosen = [modeling("bcm", "bcm_4", elements=4), modeling("prbm"), modeling("beam"),
              modeling("beam", "beam_order_3", elements=10, order=3),
              modeling("exact", modes=8), modeling("exact", "exact_12", modes=12)]
    found = flexura.run(changed, runs.study(changed, "turn", estimate=False, tolerance=1e-8,
                                            rotary_inertia=None, modelings=chosen,
                                            reference="exact_12"))
    truth, basis = bent(found["exact_12"], duration), found["exact"].summary["seconds"]
    page.table(["modeling", "deflection, by its largest", "unknowns", "steps", "cost by `exact`"], [
        [f"`{label}`", share(apart(bent(run, duration), truth)) if run.converged else "stopped",
         run.summary["unknowns"], run.summary["steps"], times(run.summary["seconds"] / basis)]
        for label, run in found.items()])
