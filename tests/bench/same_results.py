#!/usr/bin/env python3
"""Compares what two builds make of the same parts, byte for byte: figures, tables, exports and messages.

  python3 tests/bench/same_results.py OLD/spia NEW/spia [PART...] [--only NAME] [--added KEY] [--jobs N] [--limit S] [--keep DIR]

PART: files; default every sample in assets/parts and every file of ../shared/data. Each of the ways below is run on each of
them by both builds in folders of the same names, so that no path differs; times are left out of the figures and the messages.
Prints what differs and ends with 1 if anything does, with 2 if nothing could be compared.
"""
import argparse
import concurrent.futures
import filecmp
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORMATS = ("iges,step,glb,vtu,dxf,csv,png,gismo,mfem,geopdes,iga-k,dynain,nastran,mapping,"
           "blank-k,blank-bdf,blank-inp,blank-msh")
SHELLS_ONLY = ("dynain,", "nastran,", "mapping,")
DECKS = {".k", ".key", ".dyn", ".bdf", ".nas", ".dat", ".inp", ".msh", ".rad"}
PARTS = DECKS | {".obj", ".off", ".ply", ".stl", ".gltf", ".glb", ".step", ".stp", ".igs", ".iges", ".brep"}
MOST_BYTES = 30e6  # a whole car is for `info` alone
TIME = re.compile(r" *\b\d+(\.\d+)? ?(ms|s|min)\b")
SECONDS = re.compile(r"(seconds|peak_memory_mb)$")
CBOR_SECONDS = re.compile(rb"seconds(\xfb.{8}|\xfa.{4})", re.S)  # a number of 8 or 4 bytes


def formats_for(part):
    formats = FORMATS
    if part.suffix.lower() not in DECKS:
        for name in SHELLS_ONLY:
            formats = formats.replace(name, "")
    return formats


def ways(part):
    """Name -> arguments. All write below "out"."""
    run = ["run", str(part), "--out", "out", "--json", "out/figures.json"]
    yield "info", ["info", str(part), "--json", "figures.json"]
    if part.stat().st_size > MOST_BYTES:
        return
    yield "run", run + ["--formats", formats_for(part)]
    yield "patches", run + ["--patches", "auto", "--formats", "step,csv,gismo"]
    yield "fit", run + ["--tolerance", "0.2", "--skins", "--even-cells", "--formats", "iges,csv"]
    yield "unfold", ["unfold", str(part), "--auto", "--out", "out", "--json", "out/figures.json"]


def timeless(value, added):
    if isinstance(value, dict):
        return {k: timeless(v, added) for k, v in value.items() if not SECONDS.search(k) and k not in added}
    return [timeless(v, added) for v in value] if isinstance(value, list) else value


def run(program, arguments, folder, limit, added=()):
    folder.mkdir(parents=True)
    environment = {**os.environ, "SOURCE_DATE_EPOCH": "0"}
    try:
        done = subprocess.run([program, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=limit, env=environment)
        ended, said = str(done.returncode), done.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired:
        return None
    (folder / "said.txt").write_text(f"exit {ended}\n" + TIME.sub(" TIME", said))
    for figures in folder.rglob("figures.json"):
        figures.write_text(json.dumps(timeless(json.loads(figures.read_text()), added), indent=1))
    for states in folder.rglob("*.cbor"):
        states.write_bytes(CBOR_SECONDS.sub(b"seconds", states.read_bytes()[:-4]))  # and without its checksum
    return ended


def differences(old, new):
    names = {p.relative_to(old) for p in old.rglob("*") if p.is_file()}
    others = {p.relative_to(new) for p in new.rglob("*") if p.is_file()}
    for name in sorted(names ^ others):
        yield f"{name} only by the {'old' if name in names else 'new'} build"
    for name in sorted(names & others):
        if not filecmp.cmp(old / name, new / name, shallow=False):
            yield f"{name} differs"


def compare(part, way, arguments, options, folder):
    here = folder / f"{part.stem}{part.suffix.replace('.', '_')}" / way
    ends = [run(program, arguments, here / side, options.limit, options.added)
            for side, program in (("old", options.old), ("new", options.new))]
    if None in ends:
        return None, [f"no end within {options.limit} s: " + " and ".join(
            side for side, end in zip(("old", "new"), ends) if end is None)]
    found = list(differences(here / "old", here / "new"))
    if not found and not options.keep:
        shutil.rmtree(here)
    return ends[0], found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=os.path.abspath)
    parser.add_argument("new", type=os.path.abspath)
    parser.add_argument("part", nargs="*", type=pathlib.Path)
    parser.add_argument("--only", action="append", help="one of info, run, patches, fit, unfold")
    parser.add_argument("--added", action="append", default=[], metavar="KEY",
                        help="of the figures, which only the new build has: left out")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--limit", type=float, default=600, help="seconds for each run; slower ones are named")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for all that was written; default: what differs, in /tmp")
    options = parser.parse_args()
    parts = [p.resolve() for p in options.part] or sorted(
        p for folder in (ROOT / "assets/parts", (ROOT / "../shared/data").resolve())
        for p in folder.rglob("*") if p.suffix.lower() in PARTS)
    folder = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="spia-same-"))
    compared = differing = undecided = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = {pool.submit(compare, part, way, arguments, options, folder): (part, way) for part in parts
                for way, arguments in ways(part) if not options.only or way in options.only}
        for job in concurrent.futures.as_completed(jobs):
            part, way = jobs[job]
            ended, found = job.result()
            compared += ended is not None
            undecided += ended is None
            differing += ended is not None and bool(found)
            print(f"{part.name:28} {way:8} " + ("; ".join(found) if found else f"same (exit {ended})"), flush=True)
    print(f"{compared} compared, {differing} differ, {undecided} without an end; in {folder}")
    return 2 if compared == 0 else 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
