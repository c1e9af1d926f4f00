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
    axes.set_xlabel(plot["x_title"])
    if "real_time" in plot:
        axes.axhline(plot["real_time"], color="#999", linewidth=0.8, linestyle=":")
        axes.annotate(f"{plot['real_time']} frames/s", (0.995, plot["real_time"]), fontsize=8, color="#666",
                      xycoords=("axes fraction", "data"), ha="right", va="bottom")
    axes.grid(True, which="major", linewidth=0.4, color="#ccc")


def bars(axes, document, table):
    plot = document["plot"]
    columns = table.values_of(plot["y"])
    names = [", ".join(row[k] for k in table.labels()) for row in table.rows]
    width = 0.8 / len(columns)
    smallest = min((v for row in table.rows for _, _, c in columns if (v := number(row[c])) and v > 0), default=1)
    largest = max((v for row in table.rows for _, _, c in columns if (v := number(row[c])) is not None), default=1)
    ours = 0
    for k, (source, title, column) in enumerate(columns):
        theirs = source == "theirs"
        for r, row in enumerate(table.rows):
            value = number(row[column])
            if value is None:
                continue
            at = r + (k - (len(columns) - 1) / 2) * width
            shown = max(value, smallest / 3) if plot.get("log") else value
            axes.bar(at, shown, width * 0.95, color=THEIRS if theirs else OURS[ours % 6], hatch="//" if theirs else None,
                     edgecolor="white", label=title.split(":")[0] if r == first_row(table, column) else None)
            axes.annotate(row[column], (at, shown), ha="center", va="bottom", fontsize=7)
        ours += not theirs
    if plot.get("log"):
        axes.set_yscale("log")
        axes.set_ylim(smallest / 6, largest * 6)
    axes.set_xticks(range(len(names)))
    axes.set_xticklabels(names, fontsize=8, rotation=20 if max(map(len, names)) * len(names) > 90 else 0,
                         ha="right" if max(map(len, names)) * len(names) > 90 else "center")


def first_row(table, column):
    return next(r for r, row in enumerate(table.rows) if number(row[column]) is not None)


def draw(document, file):
    figure, axes = plt.subplots(figsize=(8.6, 4.6))
    table = Table(document)
    {"lines": lines, "bars": bars}[document["plot"]["kind"]](axes, document, table)
    axes.set_ylabel(document["plot"]["y_title"])
    axes.set_title(f"{document['paper']}, {document['item']}: {document['title']}", fontsize=10)
    handles, labels = axes.get_legend_handles_labels()
    if len(labels) > 1:
        axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
    devices = "; ".join(f"{machine['title']}: {machine['device']}" for machine in document["machines"])
    quick = "; quick run" if document["quick"] else ""
    figure.text(0.01, 0.005, f"theirs: GTX 1070, i7-7700 (compare ratios, not absolute numbers)   ours: {devices}{quick}",
                fontsize=6.5, color="#555")
    figure.tight_layout(rect=(0, 0.03, 1, 1))
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
