"""The four-bar of Turcic and Midha: frequencies, strains, and where linear theory ends."""

import math
import re

import runs
from measure import relative
from pages import Page, scientific, share
from pictures import picture
from plots import Series, plot

MODEL = "examples/turcic_midha_four_bar.toml"
STUDIES = {3: "elements_3", 9: "elements_9"}


def rows_of(flexura, model, study):
    """The summary and the tables of a linkage study."""
    results = flexura.folder(model, {"case": study})
    summary = runs.json.loads((results / "summary.json").read_text())["studies"]["case"]
    folder = results / "case"
    return summary, {name: runs.read_table(folder / f"{name}.csv")
                     for name in ("frequencies", "response")}


def frequency_error(found, truth):
    return max(relative(a[f"w{k}"], b[f"w{k}_rad_s"]) for a, b in zip(found, truth)
               for k in range(1, 5))


def strain_error(found, truth, equation):
    worst = 0.0
    for link in ("coupler", "follower"):
        pairs = [(a[f"periodic.{link}.strain"], b[f"eps_{link}_{equation}"])
                 for a, b in zip(found, truth)]
        largest = max(abs(b) for _, b in pairs)
        worst = max(worst, max(abs(a - b) for a, b in pairs) / largest)
    return worst


def largest_multiplier(summary):
    return max(math.hypot(m["real"], m["imaginary"]) for m in summary["floquet_multipliers"])


def against_independent(page, flexura, model):
    table = runs.reference_json("dynamics/case1_steady_table.json")
    rows, worst, found = [], [0.0, 0.0, 0.0], {}
    for count, name in STUDIES.items():
        truth = runs.reference_table(f"dynamics/case1_freq_{count}el_nogeom.csv")
        steady = runs.reference_table(f"dynamics/case1_steady_{count}el_300rpm_zeta2_nogeom.csv")
        for equation, coupling in (("eq1", True), ("eq2", False)):
            study = runs.study(model, name, methods=["periodic"], coupling=coupling)
            summary, tables = rows_of(flexura, model, study)
            known = next(t for t in table if t["elements"] == count and t["zeta"] == 0.02
                         and t["coupling"] == coupling)
            off = (frequency_error(tables["frequencies"], truth),
                   strain_error(tables["response"], steady, equation),
                   abs(largest_multiplier(summary) - known["max_multiplier"]))
            worst = [max(a, b) for a, b in zip(worst, off)]
            rows.append([f"{count} elements, {'with' if coupling else 'without'} coupling terms",
                         *map(scientific, off)])
            found[count, coupling] = tables
    page.table(["model", "four frequencies, 181 positions", "strains at mid-length",
                "largest multiplier, absolute"], rows)
    page.promise("frequencies over the turn", "beam", worst[0], 2e-9)
    page.promise("strains of coupler and follower, by their largest", "beam", worst[1], 3e-8)
    page.promise("largest multiplier of Floquet, absolute", "beam", worst[2], 1e-6)
    return found


def strain_plot(page, found):
    truth = runs.reference_table("dynamics/case1_steady_9el_300rpm_zeta2_nogeom.csv")
    series = [Series("reference", [(r["crank_deg"], 1e6 * r["eps_follower_eq1"]) for r in truth],
                     "thick", 0)]
    for k, (count, tables) in enumerate((c[0], t) for c, t in found.items() if c[1]):
        points = [(r["angle"], 1e6 * r["periodic.follower.strain"]) for r in tables["response"]]
        series.append(Series(f"{count} elements", points, "line", (2, 1)[k]))
    page.figure("strain", "Strain of the follower at mid-length over the turn at 300 rpm; the "
                "reference is that of nine elements",
                plot(series, "crank angle, deg", "strain, 1e-6"))


def bands(page, flexura, model):
    rows = []
    for name in ("elements_3", "elements_6", "elements_9", "elements_15"):
        summary, _ = rows_of(flexura, model, runs.study(model, name, methods=["quasi_static"]))
        rows.append([name.split("_")[1]] + [
            f"{b['least'] / 2 / math.pi:.1f} to {b['greatest'] / 2 / math.pi:.1f}"
            for b in summary["frequencies"][:4]])
    page.table(["elements", "mode 1, Hz", "mode 2, Hz", "mode 3, Hz", "mode 4, Hz"], rows)


def methods(page, flexura, model):
    chosen = runs.study(model, "turn", speeds=None)
    summary, tables = rows_of(flexura, model, chosen)
    rows = [[f"`{name}`", entry["unknowns"], share(entry.get("difference")),
             f"{entry['peaks']['follower']['strain']['value']:.4e}"]
            for name, entry in summary["modelings"].items()]
    page.table(["method", "unknowns", "strains, from `periodic`", "largest strain of the follower"],
               rows)
    note = next(n for n in summary["notes"] if "off by (strains)" in n)
    pairs = re.findall(r"([\d.]+) % at (\d+) rpm", note)
    page.table(["linear theory from the nonlinear motion", *(f"{rpm} rpm" for _, rpm in pairs)],
               [["strains at mid-length, of the largest", *(f"{off} %" for off, _ in pairs)]])
    series = [Series(name, [(r["angle"], 1e6 * r[f"{name}.follower.strain"])
                            for r in tables["response"]], "line", k)
              for k, name in ((8, "quasi_static"), (1, "periodic"), (2, "nonlinear"))]
    page.figure("methods", "Strain of the follower at 300 rpm by three methods",
                plot(series, "crank angle, deg", "strain, 1e-6"))
    page.promise("`transient` from `periodic`, strains", "transient",
                 summary["modelings"]["transient"]["difference"], 1e-6)
    page.facts["speeds"] = pairs
    return float(pairs[-1][0])


def veering(page, flexura, model):
    rows = []
    for continuity in ("physical", "modal"):
        for modes in (4, 8):
            study = runs.study(model, "elements_9", methods=["periodic", "midha"],
                               midha={"modes": modes, "continuity": continuity})
            summary, _ = rows_of(flexura, model, study)
            page.facts[f"{continuity} {modes}"] = share(
                summary["modelings"]["midha"]["difference"])
            rows.append([continuity, modes, share(summary["modelings"]["midha"]["difference"])])
    page.table(["continuity of", "modes", "strains, from `periodic`"],
               [["displacements" if c == "physical" else "modal coordinates", m, off]
                for c, m, off in rows])


def turcic_midha(flexura):
    page = Page("turcic_midha", "Four-bar of Turcic and Midha", [MODEL])
    model = runs.load_model(MODEL)
    page.text("""A crank-rocker of aluminium strips, 1 in wide, turns at 300 rpm; all links are
    elastic. Frequencies over the turn, the periodic vibration and its strains.""")
    page.figure("picture", "The drawn position; crank, coupler and follower", picture(model))
    page.section("Source and reference")
    page.text("""Turcic and Midha (ASME J. Dyn. Syst. Meas. Control 106, 1984), Part I, table 2
    (the third source). Its figures cannot be read to better than a few per cent. Reference:
    [an independent     solution](../../tests/data/reference/dynamics/README.md) of the same
    discrete models, frequencies to 1e-10, strains to 3e-8.""")
    page.section("The same discrete models")
    found = against_independent(page, flexura, model)
    strain_plot(page, found)
    page.section("Elements")
    bands(page, flexura, model)
    page.text("""The models of 3 to 15 elements are those of the source's figures 10 to 12. Their
    axes, in rad/s, fit these bands times 2π. Strains need more elements than frequencies: with
    one element a link their curvature is linear.""")
    page.section("Methods")
    last = methods(page, flexura, model)
    page.text(f"""**Linear theory fails before the source's own speed.** Kineto-elastodynamics with
    quasi-static axial forces is {last:.2g} % off at 300 rpm, against the periodic motion of
    geometrically exact links with the same damping. Shortening of bent links is no small correction
    near the resonances of high orders of the speed: trust `nonlinear` there.""")
    page.section("What Midha's algorithm must keep continuous")
    veering(page, flexura, model)
    page.text("""Modes 1 and 2 veer twice in a turn. With every modal coordinate carried over by
    itself the answer is wrong by as much as itself; with displacements and velocities carried
    over it is some per cent off ([findings](findings.md)).""")
    return page
