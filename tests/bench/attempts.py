#!/usr/bin/env python3
"""Counts which attempts at blank, grid and surface are needed: how often each is made and wins, and what it costs.

  python3 tests/bench/attempts.py SPIA [PART...] [--tried FILE...] [--jobs N] [--limit S]

PART: files; default, without FILE, every sample in assets/parts and every part of ../shared/data below 30 MB. Each is run by the
program SPIA in the ways below, and the traces of its JSON are counted. FILE: what `spia-robustness --attempts FILE` has written of
shapes drawn at random. An attempt has won if its result was taken, and so was that of the one which it is made within. Prints a table in Markdown.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import re
import subprocess
import tempfile

from same_results import MOST_BYTES, PARTS, ROOT

NUMBERED = re.compile(r"^grid of patch \d+$")
# Name -> arguments, and the stages that are counted: those that other ways do not run in the same manner.
WAYS = {
    "nodes": ([], ("solve", "grid")),
    "tools": (["--process", "held.json"], ("solve",)),
    "fit": (["--tolerance", "0.1"], ("fit",)),
    "corrected": (["--tolerance", "0.1", "--fit-parameters", "corrected"], ("fit",)),
    "patches": (["--patches", "auto"], ("patches",)),
}


class Count:
    def __init__(self):
        self.made = self.won = 0
        self.seconds = 0.0
        self.where = set()


def stages(figures):
    """Stage -> its trace."""
    surface = figures.get("surface", {})
    yield "solve", figures.get("solve", {}).get("attempts", [])
    yield "grid", figures.get("grid", {}).get("attempts", [])
    yield "fit" if "patches" not in surface else "patches", surface.get("fit", {}).get("attempts", [])


def add(table, path, trace, shape, wins=True):
    for attempt in trace:
        name = "grid of a patch" if NUMBERED.match(attempt["name"]) else attempt["name"]
        here = path + (name,)
        row = table.setdefault(here, Count())
        row.made += 1
        row.seconds += attempt["seconds"]
        won = wins and attempt["won"]
        if won:
            row.won += 1
            row.where.add(shape)
        add(table, here, attempt.get("attempts", []), shape, won)


def figures_of(program, part, way, limit):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "held.json").write_text('{"edge_restraint": 0.05}')
        try:
            subprocess.run([program, "run", str(part), *WAYS[way][0], "--formats", "csv", "--out", "out", "--json", "f.json"],
                           cwd=folder, capture_output=True, timeout=limit)
            return json.loads((folder / "f.json").read_text())
        except (subprocess.TimeoutExpired, FileNotFoundError):
            return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("part", nargs="*", type=pathlib.Path)
    parser.add_argument("--tried", nargs="*", type=pathlib.Path, default=[])
    parser.add_argument("--only", action="append", choices=WAYS)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--limit", type=float, default=600, help="seconds for each run")
    options = parser.parse_args()
    program = options.program.resolve()
    parts = [p.resolve() for p in options.part]
    if not parts and not options.tried:
        parts = sorted(p for folder in (ROOT / "assets/parts", (ROOT / "../shared/data").resolve()) for p in folder.rglob("*")
                       if p.suffix.lower() in PARTS and p.stat().st_size <= MOST_BYTES)
    table, runs, without = {}, collections.Counter(), []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = {pool.submit(figures_of, program, part, way, options.limit): (part, way)
                for part in parts for way in options.only or WAYS}
        for job in concurrent.futures.as_completed(jobs):
            part, way = jobs[job]
            figures = job.result()
            if figures is None or "solve" not in figures:
                without.append(f"{part.name} ({way})")
                continue
            runs[way] += 1
            for stage, trace in stages(figures):
                if stage in WAYS[way][1]:
                    add(table, (f"{stage}, held edge" if way == "tools" else
                                f"{stage}, corrected" if way == "corrected" else stage,), trace, part.name)
    for file in options.tried:
        for shape in json.loads(file.read_text()):
            for stage in ("solve", "grid", "fit"):
                add(table, (f"{'patches' if stage == 'fit' else stage}, {file.stem}",), shape.get(stage, {}).get("attempts", []),
                    shape["input"])
            runs[file.stem] += 1
    print(f"{', '.join(f'{count} of {way}' for way, count in runs.items())}; without a blank, or too slow: {len(without)}"
          + (f" ({', '.join(sorted(without))})" if without else "") + "\n")
    print("| stage | attempt | made | won | s | won on |\n|---|---|---|---|---|---|")
    for path in in_order(table):
        row = table[path]
        where = sorted(row.where)
        print(f"| {path[0]} | {'· ' * (len(path) - 2)}{path[-1]} | {row.made} | {row.won} | {row.seconds:.1f} | "
              + ", ".join(where[:4]) + (f" and {len(where) - 4} more" if len(where) > 4 else "") + " |")


def in_order(table):
    """Each path after that which it is within, in the order in which they first came up."""
    def below(prefix):
        for path in table:
            if len(path) == len(prefix) + 1 and path[:-1] == prefix:
                yield path
                yield from below(path)
    for stage in dict.fromkeys(path[0] for path in table):
        yield from below((stage,))


if __name__ == "__main__":
    main()
