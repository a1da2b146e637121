"""Line plots as SVG, in the colours of the report (flexura/report/page/style.css)."""

import math
from dataclasses import dataclass

COLOURS = 9
STYLE = """<style>
svg { --panel: #ffffff; --ink: #1b1e21; --soft: #555c63; --faint: #737b83; --rule: #dcdedb;
  --strong: #b5b9b8; --ghost: #b3b8bb; --c0: #1b1e21; --c1: #0072b2; --c2: #d55e00; --c3: #009271;
  --c4: #c0609a; --c5: #a57c00; --c6: #7a4b1e; --c7: #8566cc; --c8: #6a6f75; }
@media (prefers-color-scheme: dark) { svg { --panel: #1b1f23; --ink: #e4e6e7; --soft: #b0b6bb;
  --faint: #8d959c; --rule: #31373c; --strong: #535b62; --ghost: #555d64; --c0: #f0f1f1;
  --c1: #56b4f0; --c2: #ff8b3d; --c3: #2cc79a; --c4: #e79ac8; --c5: #e6c04a; --c6: #c99a6b;
  --c7: #b7a0f0; --c8: #a0a6ac; } }
text { font: 12.5px system-ui, "Segoe UI", "Helvetica Neue", "Liberation Sans", Arial, sans-serif;
  font-variant-numeric: tabular-nums; fill: var(--soft); }
.title { font-weight: 600; fill: var(--ink); } .faint { fill: var(--faint); }
.panel { fill: var(--panel); } .grid { stroke: var(--rule); } .axis { stroke: var(--strong); }
.line { fill: none; stroke-width: 1.7; stroke-linejoin: round; }
.thick { stroke-width: 4.5; stroke-opacity: 0.35; } .dashed { stroke-dasharray: 6 4; }
.mark { stroke-width: 1.5; fill: var(--panel); }
</style>"""


@dataclass
class Series:
    """A curve. `style`: "marks" (line with marks), "line", "thick" (behind others), "dots"."""

    name: str
    points: list
    style: str = "marks"
    colour: int = 1


class Scale:
    """From values to pixels, linear or logarithmic, with its ticks."""

    def __init__(self, values, low, high, logarithmic):
        self.logarithmic = logarithmic
        start, end = min(values), max(values)
        if logarithmic:
            start, end = padded_decades(start, end)
        else:
            pad = 0.04 * ((end - start) or 1.0)
            start, end = start - pad, end + pad
        self.start, self.end, self.low, self.high = start, end, low, high

    def __call__(self, value):
        place = math.log10(value) if self.logarithmic else value
        return self.low + (place - self.start) / (self.end - self.start) * (self.high - self.low)

    def ticks(self):
        if not self.logarithmic:
            return [(value, plain(value)) for value in round_values(self.start, self.end)]
        first, last = math.ceil(self.start - 1e-9), math.floor(self.end + 1e-9)
        every = max(1, math.ceil((last - first) / 8))
        ticks = [(10.0**k, power(k)) for k in range(first, last + 1) if k % every == 0]
        if len(ticks) < 3 and self.end - self.start < 3.2:
            ticks = [(m * 10.0**k, plain(m * 10.0**k)) for k in range(first - 1, last + 1)
                     for m in (1, 2, 5)]
            ticks = [t for t in ticks if self.start - 1e-9 <= math.log10(t[0]) <= self.end + 1e-9]
        return ticks


def padded_decades(start, end):
    low, high = math.log10(start), math.log10(end)
    pad = max(0.06 * (high - low), 0.08)
    return low - pad, high + pad


def round_values(start, end):
    raw = (end - start) / 6.5
    size = 10.0 ** math.floor(math.log10(raw))
    step = next(size * m for m in (1, 2, 5, 10) if size * m >= raw)
    first = math.ceil(start / step)
    return [k * step for k in range(first, math.floor(end / step) + 1)]


def plain(value):
    text = f"{value:.6g}"
    return text.replace("-", "\u2212")


def power(exponent):
    raised = str(exponent).replace("-", "\u2212")
    return f'10<tspan dy="-5" font-size="9.5">{raised}</tspan>'


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;")


def svg(width, height, parts):
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}">')
    back = f'<rect class="panel" width="{width}" height="{height}" rx="6"/>'
    return "\n".join([head, STYLE, back, *parts, "</svg>\n"])


def axes(x, y, box, titles):
    left, top, right, bottom = box
    parts = []
    for value, text in x.ticks():
        at = x(value)
        parts.append(f'<path class="grid" d="M{at:.1f} {top}V{bottom}"/>'
                     f'<text x="{at:.1f}" y="{bottom + 19}" text-anchor="middle">{text}</text>')
    for value, text in y.ticks():
        at = y(value)
        parts.append(f'<path class="grid" d="M{left} {at:.1f}H{right}"/>'
                     f'<text x="{left - 8}" y="{at + 4:.1f}" text-anchor="end">{text}</text>')
    parts.append(f'<path class="axis" fill="none" d="M{left} {top}V{bottom}H{right}"/>')
    parts.append(f'<text class="title" x="{left - 48}" y="{top - 16}">{escaped(titles[1])}</text>')
    parts.append(f'<text class="faint" x="{right}" y="{bottom + 38}" text-anchor="end">'
                 f'{escaped(titles[0])}</text>')
    return parts


MARKS = ("M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0Z", "M-3.6-3.6H3.6V3.6H-3.6Z", "M0-4.8L4.6 3.6H-4.6Z",
         "M0-5L5 0L0 5L-5 0Z", "M0 4.8L4.6-3.6H-4.6Z")


def curve(series, x, y, index):
    colour = f"var(--c{series.colour % COLOURS})"
    places = [(x(a), y(b)) for a, b in series.points]
    path = "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in places)
    parts = []
    if series.style != "dots":
        extra = {"thick": " thick", "dashed": " dashed"}.get(series.style, "")
        parts.append(f'<path class="line{extra}" stroke="{colour}" d="{path}"/>')
    if series.style in ("marks", "dots"):
        mark = MARKS[index % len(MARKS)]
        parts += [f'<path class="mark" stroke="{colour}" transform="translate({a:.1f} {b:.1f})" '
                  f'd="{mark}"/>' for a, b in places]
    return parts


def legend(all_series, left, top):
    parts = []
    for index, series in enumerate(all_series):
        at = top + 21 * index
        colour = f"var(--c{series.colour % COLOURS})"
        if series.style != "dots":
            extra = {"thick": " thick", "dashed": " dashed"}.get(series.style, "")
            parts.append(f'<path class="line{extra}" stroke="{colour}" '
                         f'd="M{left} {at}h24"/>')
        if series.style in ("marks", "dots"):
            parts.append(f'<path class="mark" stroke="{colour}" '
                         f'transform="translate({left + 12} {at})" '
                         f'd="{MARKS[index % len(MARKS)]}"/>')
        parts.append(f'<text x="{left + 32}" y="{at + 4.5}">{escaped(series.name)}</text>')
    return parts


def plot(all_series, x_title, y_title, log_x=False, log_y=False):
    """The plot of all series, which must have points; logarithmic axes want positive values."""
    all_series = [series for series in all_series if series.points]
    width, height = 760, max(380, 110 + 21 * len(all_series))
    words = max(len(series.name) for series in all_series)
    box = (66, 44, width - 66 - int(7.3 * words), height - 56)
    xs = [a for series in all_series for a, _ in series.points]
    ys = [b for series in all_series for _, b in series.points]
    x = Scale(xs, box[0], box[2], log_x)
    y = Scale(ys, box[3], box[1], log_y)
    parts = axes(x, y, box, (x_title, y_title))
    for index, series in enumerate(all_series):
        parts += curve(series, x, y, index)
    parts += legend(all_series, box[2] + 16, box[1] + 8)
    return svg(width, height, parts)
