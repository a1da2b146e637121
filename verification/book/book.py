"""The list of pages, and the book written to docs/verification."""

import time

import cantilevers
import chain
import columns
import frames
import linkages
import motion
import pivots
import solids
import stability
from runs import TOP, Flexura

FOLDER = TOP / "docs/verification"
PAGES = {"arc_chain": chain.arc_chain, "compliant_four_bar": frames.four_bar,
         "printed_elements": frames.printed_elements,
         "cross_spring": pivots.cross_spring, "parallelogram": pivots.parallelogram,
         "circular_hinge": pivots.circular_hinge, "lee_frame": stability.lee_frame,
         "snap_through": stability.arch_and_toggle, "columns": columns.columns,
         "thick_ring": solids.thick_ring,
         "frame_frequencies": motion.frame_frequencies, "frame_history": motion.frame_history,
         "cantilever_frequencies": motion.cantilever_frequencies, "spin_up": motion.spin_up,
         "turcic_midha": linkages.turcic_midha,
         "tip_load": cantilevers.tip_load, "roll_up": cantilevers.roll_up}


def write_page(page, folder):
    (folder / "images").mkdir(parents=True, exist_ok=True)
    for file, drawing in page.figures.items():
        (folder / "images" / file).write_text(drawing)
    (folder / f"{page.name}.md").write_text(page.markdown())


def write(command, tests, names):
    flexura = Flexura(command)
    made = []
    for name in names or PAGES:
        started = time.monotonic()
        page = PAGES[name](flexura)
        write_page(page, FOLDER)
        made.append(page)
        print(f"{name}: {time.monotonic() - started:.1f} s")
    return all(p.kept for page in made for p in page.promises)
