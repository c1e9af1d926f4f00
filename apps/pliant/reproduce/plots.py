#!/usr/bin/env python3
"""Draws the figures of a report by pliant reproduce: plots.py FOLDER ID...

Reads FOLDER/data/ID.json, whose "plot" says what to draw, and writes FOLDER/figures/ID.svg. The numbers are those of
the table, as it has them.
"""
import json
import os
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib import ticker

OURS = ["#1f5fa8", "#2a9d5c", "#7b4bab", "#c23b4e", "#5a6b7a", "#0f8b8d"]
THEIRS = "#d98200"
MARKERS = "osD^vP"


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


class Table:
    """The first table of a document, by columns."""

    def __init__(self, document):
        table = document["tables"][0]
        self.columns, self.rows = table["columns"], table["rows"]

    def index(self, name):
        return next(k for k, column in enumerate(self.columns) if column["name"] == name)

    def values_of(self, name):
        """Columns with this quantity: (source, title, index)."""
        return [(c["source"], c["title"], k) for k, c in enumerate(self.columns)
                if c["name"] == name and c["source"] not in ("case", "ratio")]

    def labels(self):
        return [k for k, c in enumerate(self.columns) if c["source"] == "case" and c["name"] == c["title"]
                and c["name"] not in ("nodes", "springs", "frames")]


def lines(axes, document, table):
    plot = document["plot"]
    x = table.index(plot["x"])
    by = [table.index(name) for name in plot.get("by", [])]
    colour = 0
    for source, title, column in table.values_of(plot["y"]):
        groups = {}
        for row in table.rows:
            point = number(row[x]), number(row[column])
            if None not in point:
                groups.setdefault(tuple(row[k] for k in by), []).append(point)
        for group, points in groups.items():
            name = ", ".join((title.split(":")[0],) + group)
            points.sort()
            if source == "theirs":
                axes.plot(*zip(*points), linestyle="none", marker="*", markersize=12, color=THEIRS,
                          alpha=0.9 if not group else 0.75, label=name)
            else:
                axes.plot(*zip(*points), marker=MARKERS[colour % 6], color=OURS[colour % 6], markersize=5,
                          linestyle="-" if colour < 6 else "--", label=name)
                colour += 1
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in axes.xaxis, axes.yaxis:
        axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5), numticks=20))
        axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:,.10g}"))
        axis.set_minor_formatter(ticker.NullFormatter())
    low, high = axes.get_xlim()
    if high > 100 * low:  # numbers of three decades have no room for more than a label to each
        axes.xaxis.set_major_locator(ticker.LogLocator(numticks=20))
    axes.set_xlabel(plot["x_title"])
    if "real_time" in plot:
        axes.axhline(plot["real_time"], color="#999", linewidth=0.8, linestyle=":")
        axes.annotate(f"{plot['real_time']} frames/s", (0.005, plot["real_time"]), fontsize=8, color="#666",
                      xycoords=("axes fraction", "data"), ha="left", va="bottom")
    axes.grid(True, which="major", linewidth=0.4, color="#ccc")


def bars(axes, document, table):
    plot = document["plot"]
    columns = table.values_of(plot["y"])
    names = [", ".join(row[k] for k in table.labels()) for row in table.rows]
    width = 0.8 / len(columns)
    values = [v for row in table.rows for _, _, c in columns if (v := number(row[c])) is not None]
    smallest, largest = min((v for v in values if v > 0), default=1), max(values, default=1)
    bottom, top = (smallest / 6, largest * 6) if plot.get("log") else (0, 1.15 * largest)
    ours = 0
    for k, (source, title, column) in enumerate(columns):
        theirs = source == "theirs"
        named = False
        for r, row in enumerate(table.rows):
            if not row[column]:
                continue
            value = number(row[column])
            at = r + (k - (len(columns) - 1) / 2) * width
            shown = top if value is None else max(value, bottom)  # a word: it diverged
            axes.bar(at, shown - bottom, width * 0.95, bottom=bottom, color=THEIRS if theirs else OURS[ours % 6],
                     hatch="//" if theirs else "xx" if value is None else None, edgecolor="white",
                     label=None if named else title.split(":")[0])
            named = True
            middle = (bottom * top) ** 0.5 if plot.get("log") else (bottom + top) / 2
            axes.annotate(row[column], (at, middle if value is None else shown), ha="center", va="bottom", fontsize=7,
                          bbox={"color": "white", "pad": 1} if value is None else None)
        ours += not theirs
    if plot.get("log"):
        axes.set_yscale("log")
    axes.set_ylim(bottom, top)
    axes.set_xlabel(", ".join(table.columns[k]["title"] for k in table.labels()))
    axes.set_xticks(range(len(names)))
    axes.set_xticklabels(names, fontsize=8, rotation=20 if max(map(len, names)) * len(names) > 90 else 0,
                         ha="right" if max(map(len, names)) * len(names) > 90 else "center")


def draw(document, file):
    figure, axes = plt.subplots(figsize=(8.6, 4.6))
    table = Table(document)
    {"lines": lines, "bars": bars}[document["plot"]["kind"]](axes, document, table)
    axes.set_ylabel(document["plot"]["y_title"])
    axes.set_title(f"{document['paper']}, {document['item']}: {document['title']}", fontsize=10)
    handles, labels = axes.get_legend_handles_labels()
    if len(labels) > 1:
        axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
    devices = "; ".join(("" if machine["title"] == "ours" else f"{machine['title']}: ") + machine["device"]
                        for machine in document["machines"])
    quick = "; quick run" if document["quick"] else ""
    busy = "; on a busy machine, speeds uncertain" if any("busy machine" in note for note in document["notes"]) else ""
    figure.text(0.01, 0.005, f"theirs: on a GTX 1070 and an i7-7700; compare ratios, not absolute numbers\n"
                f"ours: on {devices}{quick}{busy}", fontsize=6.5, color="#555")
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    partial = file.with_suffix(".part")
    figure.savefig(partial, format="svg", metadata={"Date": None})
    os.replace(partial, file)
    plt.close(figure)


def main():
    # Texts stay texts, and the same numbers give the same file.
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "pliant", "font.family": "sans-serif",
                         "axes.spines.top": False, "axes.spines.right": False})
    folder = Path(sys.argv[1])
    for name in sys.argv[2:]:
        document = json.loads((folder / "data" / f"{name}.json").read_text())
        if "plot" in document:
            draw(document, folder / "figures" / f"{name}.svg")


if __name__ == "__main__":
    main()
