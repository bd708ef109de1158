#!/usr/bin/env python3
"""Each source includes what it names of the project, itself or by way of what it includes.

Sources that are compiled together, a folder at once, hide an include that one of them lacks: the
presets that compile each on its own (fuzz, tidy) are then broken. Looked for is what a header
declares at namespace scope: constants, functions, types, enumerations. A name that a source also
uses in another sense (a member, a local variable) is left alone.

Usage: missing_includes.py [ROOT]
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])
FOLDERS = ("engine", "app", "tests")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
NOISE = re.compile(r'R"(\w*)\(.*?\)\1"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
NAME = re.compile(r"[A-Za-z_]\w*")
DECLARED = [
    re.compile(r"\b(?:struct|class|enum(?: class)?)\s+(\w+)\s*[;:{]"),
    re.compile(r"\busing\s+(\w+)\s*="),
    re.compile(r"\bconstexpr\b[^;{=()]*?\b(\w+)\s*(?:\[\w*\]\s*)?[={]"),
    re.compile(r"[\w>&*]\s+[&*]?(\w+)\s*\([^()]*(?:\([^()]*\)[^()]*)*\)\s*(?:const\s*)?(?:noexcept\s*)?[;{]"),
]
SPOKEN = re.compile(r"[a-z]_[a-z]|[a-z][A-Z]")  # of two words, which no local variable has by chance
# A member, a declaration here, one of several variables or enumerators, the name of a test.
OTHER = (
    r"(?:\.|->|[\w>]::)\s*NAME\b|[\w>\]][&*]?\s+[&*]?NAME\s*[;,=({)\[:]|[&*]NAME\s*[;,=)]"
    r"|,\s*NAME\s*(?:=[^;()]*|\([^;]*\))?;|[,{\[]\s*NAME\s*[,}\]]|\bTEST\w*\(\s*NAME\b"
)
WORDS = {"operator", "return", "if", "while", "for", "switch", "sizeof", "static_assert", "defined", "noexcept"}


def code_of(path):
    return NOISE.sub(lambda found: "\n" * found[0].count("\n"), path.read_text())


def at_namespace_scope(code):
    """The code without preprocessor lines and without the bodies of all that is no namespace."""
    code = re.sub(r"^\s*#(?:[^\n]*\\\n)*[^\n]*", "", code, flags=re.M)
    kept, depth, start = [], 0, 0
    for match in re.finditer(r"[{}]", code):
        if match[0] == "{":
            if depth == 0:
                head = code[start : match.start()]
                if re.search(r"\bnamespace\b[\w\s:]*$", head):
                    start = match.end()
                    continue
                kept.append(head + "{")
            depth += 1
        elif depth > 0:
            depth -= 1
            if depth == 0:
                kept.append("}")
                start = match.end()
        else:
            kept.append(code[start : match.start()])
            start = match.end()
    kept.append(code[start:])
    return "".join(kept)


def main():
    files = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*")) if path.suffix in (".h", ".cpp")]
    name = {path: path.relative_to(ROOT).as_posix() for path in files}
    includes = {name[path]: INCLUDE.findall(path.read_text()) for path in files}
    code = {name[path]: code_of(path) for path in files}

    declares = collections.defaultdict(set)
    for header in (each for each in code if each.endswith(".h")):
        scope = at_namespace_scope(code[header])
        for pattern in DECLARED:
            for word in pattern.findall(scope):
                if SPOKEN.search(word) and word not in WORDS:
                    declares[word].add(header)

    def reached(start):
        seen, left = set(), [start]
        while left:
            here = left.pop()
            if here not in seen:
                seen.add(here)
                left += includes.get(here, [])
        return seen

    bad = 0
    for source, text in code.items():
        there = reached(source)
        may_use = FOLDERS[: FOLDERS.index(source.split("/")[0]) + 1]
        for word in sorted(set(NAME.findall(INCLUDE.sub("", text)))):
            headers = {each for each in declares.get(word, ()) if each.split("/")[0] in may_use}
            if not headers or headers & there:
                continue
            used = [m.start() for m in re.finditer(rf"(?<![\w.:>]){word}\b", text)]
            if not used or re.search(OTHER.replace("NAME", word), text):
                continue
            line = text.count("\n", 0, used[0]) + 1
            print(f"{source}:{line}: {word} is declared in {' or '.join(sorted(headers))}, which is not included")
            bad += 1
    print(f"{bad} names lack an include" if bad else f"{len(code)} files include what they name")
    return 1 if bad or len(declares) < 1000 else 0


if __name__ == "__main__":
    sys.exit(main())
