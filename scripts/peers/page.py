"""The plot, the tables and the list of what was measured; tables go between two marks of docs/peers.md."""

from pathlib import Path

import figures
import plot
from figures import short

# What stands between these is made by scripts/compare-peers; a block for each size.
BEGIN, END = "<!-- measured at {} -->", "<!-- end of {} -->"
LINES = ("vsgl path", "Mitsuba", "Mitsuba + OIDN", "Cycles", "Cycles + OIDN")
TARGETS = (
    ("indirect", "box", 20),
    ("indirect", "box", 10),
    ("whole", "pixel", 12),
    ("whole", "box", 12),
    ("whole", "box", 9),
)
SCALES = {"pixel": "per pixel", "box": "8x8 blocks"}


def label(setting):
    """A setting of vsgl in a table."""
    lights, rsm, interleave, occlusion, *more = setting
    return f"{lights} lights, rsm {rsm}, N = {interleave}, {occlusion}" + "".join(" " + w for w in more)


def points(entries, layer, scale):
    """(CPU seconds, MAPE), CPU seconds the least of the runs."""
    return [(v["cpu"][0], v["errors"][layer][scale]["mape"]) for _, v in entries if layer in v["errors"]]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| --- |" + " --- |" * (len(head) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def questions(found):
    """CPU seconds to an error, by each method and scene."""
    blocks = []
    for layer, scale, error in TARGETS:
        methods = list(next(iter(found.values()))["methods"])
        rows = []
        for method in methods:
            row = [method]
            for about in found.values():
                known = points(about["methods"].get(method, []), layer, scale)
                row.append(reached(method, known, error))
            if any(cell != "–" for cell in row[1:]):
                rows.append(row)
        title = f"{layer} light, {error} % {SCALES[scale]}"
        blocks.append(table([title, *found], rows))
    return "\n\n".join(blocks)


def reached(method, known, error):
    """The time as a cell: interpolated for samples, the cheapest setting for vsgl, bounds where it lies outside."""
    if not known:
        return "–"
    time = figures.crossing(known, error)
    if method not in LINES or not time:
        best = figures.cheapest(known, error)
        if best is None:
            return f"not in {short(max(t for t, _ in known))} s ({short(min(e for _, e in known))} %)"
        if method in LINES:
            return f"< {short(best[0])} s ({short(best[1])} %)"
        return f"{short(best[0])} s ({short(best[1])} %)"
    return f"{short(time)} s"


def all_figures(found):
    """Every picture that was measured, as lines of comma-separated values."""
    judged = [(layer, scale) for layer in ("indirect", "whole") for scale in ("pixel", "box")]
    head = ["scene", "method", "setting", "cpu_least", "cpu_most", "wall_least", *("mape_%s_%s" % j for j in judged)]
    lines = [",".join(head)]
    for name, about in found.items():
        for method, entries in about["methods"].items():
            for what, value in entries:
                what = f"{what} spp" if isinstance(what, int) else what.replace(",", ";")
                times = [value["cpu"][0], value["cpu"][-1], value["wall"][0]]
                errors = [value["errors"].get(layer, {}).get(scale, {}).get("mape") for layer, scale in judged]
                lines.append(",".join([name, method, what, *("" if n is None else f"{n:.4g}" for n in times + errors)]))
    return "\n".join(lines) + "\n"


def mismatch(found):
    """How far each method's picture of direct light is from the reference's, at its most samples."""
    methods = [m for m in next(iter(found.values()))["methods"] if "OIDN" not in m]
    rows = []
    for method in methods:
        row = [method]
        for about in found.values():
            entries = [v for _, v in about["methods"].get(method, []) if "direct" in v["errors"]]
            if not entries:
                row.append("–")
                continue
            direct, whole = entries[-1]["errors"]["direct"]["box"], entries[-1]["errors"]["whole"]["box"]
            row.append(f"{short(direct['mape'])} % ({direct['bias']:+.2f}; whole {whole['bias']:+.2f})")
        rows.append(row)
    return table(["direct light, 8x8 blocks: MAPE (bias; bias of the whole)", *found], rows)


def references(found):
    """Noise of the references that were made, and how far they are from the ground truth at half the size."""
    rows = []
    for name, about in found.items():
        if not about["reference"]:
            continue
        for layer, told in about["reference"].items():
            noise, truth = told["noise"], told.get("truth")
            agree = f"{short(truth['box']['mape'])} %, {truth['box']['bias']:+.2f} %" if truth else "–"
            rows.append([f"{name}, {layer}", f"{short(noise['pixel'])} %", f"{short(noise['box'])} %", agree])
    if not rows:
        return "The references are the ground truth's pictures; its README states their noise."
    return table(
        ["reference", "its noise per pixel", "in 8x8 blocks", "ground truth at half the size: MAPE of blocks, bias"],
        rows,
    )


def rates(found, size):
    """Samples per pixel and second of two cores: those of the most samples over twice their CPU time."""
    rows = []
    for method in ("vsgl path", "Mitsuba", "Cycles"):
        row = [method]
        for about in found.values():
            entries = about["methods"].get(method)
            row.append(short(2 * entries[-1][0] / entries[-1][1]["cpu"][0]) if entries else "–")
        rows.append(row)
    return table([f"samples per pixel and second of two cores, {size[0]}x{size[1]}", *found], rows)


def shadowless(found):
    rows = []
    for name, about in found.items():
        for what, value in about["shadowless"]:
            judged = value["errors"]["indirect"]
            rows.append(
                [name, what, short(value["cpu"][0]), short(judged["pixel"]["mape"], 3), short(judged["box"]["mape"], 3)]
            )
    return table(["scene, 320x180", "setting", "CPU s", "indirect, pixel", "indirect, box"], rows)


def tables(found, told):
    width, height = told["size"]
    versions = ", ".join(f"{k} {v}" for k, v in told["pins"].items() if told["blender"] or k != "bpy")
    parts = [
        f"{width}x{height} pixels, {told['threads']} threads; {versions}. CPU seconds are the least of the runs; errors are MAPE.",
        "### CPU time to an error",
        questions(found),
        "### Samples in a second",
        rates(found, told["size"]),
        "### Whether they render the same",
        mismatch(found),
        references(found),
        "### Without indirect shadows, against the shadowless reference",
        shadowless(found),
    ]
    return "\n\n".join(parts)


def drawing(found):
    rows = []
    for layer, scale in (("indirect", "box"), ("whole", "pixel"), ("whole", "box")):
        row = []
        for name, about in found.items():
            series = [
                {"name": method, "points": points(entries, layer, scale), "line": method in LINES}
                for method, entries in about["methods"].items()
            ]
            series = [s for s in series if s["points"]]
            row.append({"title": f"{name}: {layer}, {SCALES[scale]}", "series": series})
        rows.append(row)
    return plot.picture(rows, "CPU seconds", "mean absolute percentage error")


def write(folder, found, told):
    """The plot, and the block of the page `peers.md` for this size, which is added where there is none."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    size = "{}x{}".format(*told["size"])
    drawn = folder / f"peers-{size}.svg"
    drawn.write_text(drawing(found))
    listed = folder / f"peers-{size}.csv"
    listed.write_text(all_figures(found))
    page = folder / "peers.md"
    text = page.read_text() if page.exists() else "# Beside other renderers\n"
    block = f"## {size}\n\n![error against CPU time]({drawn.name})\n\nEvery picture: [{listed.name}]({listed.name}).\n\n{tables(found, told)}"
    page.write_text(with_block(text, size, block))
    print(f"{drawn}\n{listed}\n{page}")


def with_block(text, size, block):
    """The page with this block in place of the one of that size, or at its end."""
    begin, end = BEGIN.format(size), END.format(size)
    if begin not in text:
        text += f"\n{begin}\n{end}\n"
    before, rest = text.split(begin, 1)
    after = rest.split(end, 1)[1]
    return f"{before}{begin}\n\n{block}\n\n{end}{after}"
