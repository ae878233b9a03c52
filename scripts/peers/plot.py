"""Panels of error against time on logarithmic axes, as one SVG without references outside."""

import math
from xml.sax.saxutils import escape

from figures import decades, front

WIDTH, HEIGHT = 300, 230
LEFT, RIGHT, TOP, BOTTOM = 46, 10, 24, 34
LEGEND = 40
# Colours that are told apart by most eyes (Okabe and Ito 2008), one a method, in the order of the legend.
COLOURS = ["#d55e00", "#0072b2", "#009e73", "#000000", "#cc79a7", "#56b4e9", "#e69f00"]
STYLE = """
  text { font: 11px sans-serif; fill: #333 } .title { font-weight: bold } .mark { font-size: 10px }
  .grid { stroke: #ddd } .axis { stroke: #333; fill: none } .dot { stroke: white; stroke-width: 0.7 }
"""


def bounds(values):
    """Low and high of an axis around the values."""
    if not values:
        return 0.1, 10.0
    return min(values) / 1.25, max(values) * 1.25


def panel(about, names, limits):
    """One panel of series; `limits` are (low, high) of time and of error."""
    (t0, t1), (e0, e1) = limits

    def x(time):
        return LEFT + (WIDTH - LEFT - RIGHT) * math.log(time / t0) / math.log(t1 / t0)

    def y(error):
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * math.log(error / e0) / math.log(e1 / e0)

    out = [f'<text class="title" x="{LEFT}" y="16">{escape(about["title"])}</text>']
    for time in decades(t0, t1):
        out.append(f'<line class="grid" x1="{x(time):.1f}" x2="{x(time):.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}"/>')
        out.append(
            f'<text class="mark" x="{x(time):.1f}" y="{HEIGHT - BOTTOM + 13}" text-anchor="middle">{time:g}</text>'
        )
    for error in decades(e0, e1):
        out.append(f'<line class="grid" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y(error):.1f}" y2="{y(error):.1f}"/>')
        out.append(f'<text class="mark" x="{LEFT - 4}" y="{y(error) + 3:.1f}" text-anchor="end">{error:g}</text>')
    out.append(
        f'<rect class="axis" x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" height="{HEIGHT - TOP - BOTTOM}"/>'
    )
    for series in about["series"]:
        colour = COLOURS[names.index(series["name"]) % len(COLOURS)]
        line = series["points"] if series["line"] else front(series["points"])
        path = " ".join(f"{x(t):.1f},{y(e):.1f}" for t, e in line)
        out.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.5"/>')
        for t, e in series["points"]:
            out.append(f'<circle class="dot" cx="{x(t):.1f}" cy="{y(e):.1f}" r="3" fill="{colour}"/>')
    return out


def picture(rows, time_label, error_label):
    """Rows of panels `{title, series: [{name, points, line}]}`; panels of a row share the axis of errors.

    `line` joins all points in their order; without it the front alone is joined. One legend for all.
    """
    names = []
    for about in (p for row in rows for p in row):
        names += [s["name"] for s in about["series"] if s["name"] not in names]
    width = WIDTH * max(len(row) for row in rows)
    height = HEIGHT * len(rows) + LEGEND
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">',
        f"<style>{STYLE}</style>",
        f'<rect width="{width}" height="{height}" fill="white"/>',
    ]
    at = 12
    for number, name in enumerate(names):
        out.append(f'<circle cx="{at}" cy="14" r="5" fill="{COLOURS[number % len(COLOURS)]}"/>')
        out.append(f'<text x="{at + 9}" y="18">{escape(name)}</text>')
        at += 30 + 6.5 * len(name)
    out.append(f'<text x="12" y="35">{escape(error_label)} (upwards) against {escape(time_label)}</text>')
    times = [t for row in rows for p in row for s in p["series"] for t, _ in s["points"]]
    for number, row in enumerate(rows):
        errors = [e for p in row for s in p["series"] for _, e in s["points"]]
        for column, about in enumerate(row):
            out.append(f'<g transform="translate({column * WIDTH} {LEGEND + number * HEIGHT})">')
            out += panel(about, names, (bounds(times), bounds(errors)))
            out.append("</g>")
    out.append("</svg>")
    return "\n".join(out) + "\n"
