"""usage: check_report.py SPIA REPORT.html RESULT.json mm|inch PATTERN

The report is one file that needs no other, has the size of the blank that the JSON tells, and the pattern; its
pictures are PNG files, and each option that it names is one of the command line."""
import base64
import html as markup
import json
import re
import subprocess
import sys

spia, report, result, unit, pattern = sys.argv[1:]
html = open(report, encoding="utf-8").read()
figures = json.load(open(result, encoding="utf-8"))
faults = []

left, low, right, high = figures["blank"]["bounding_box_mm"]
each, digits, word = (25.4, 4, "in") if unit == "inch" else (1, 2, "mm")
size = " \u00d7 ".join("{:,.{}f}".format(length / each, digits).replace(",", "\u202f") for length in (right - left, high - low))
if f"{size} {word}" not in html:
    faults.append(f"no blank of {size} {word}")
for fact in re.findall(r"""(?:src|href|url)\s*[=(]\s*["']?([^"')>\s]*)""", html):
    if not fact.startswith("data:image/png;base64,"):
        faults.append(f"refers to {fact}")
if "http" in html:
    faults.append("names an address")
pictures = re.findall(r"data:image/png;base64,([^\"]*)\"", html)
if len(pictures) != (2 if "grid" in figures or "surface" in figures else 1):
    faults.append(f"{len(pictures)} pictures")
for picture in pictures:
    if not base64.b64decode(picture, validate=True).startswith(b"\x89PNG\r\n\x1a\n"):
        faults.append("a picture is no PNG file")
text = markup.unescape(re.sub(r"<style>.*?</style>|<[^>]*>", " ", html, flags=re.S))
known = subprocess.run([spia, "run", "--help"], check=True, capture_output=True, text=True).stdout
for option in re.findall(r"--[a-z][a-z-]*", text):
    if not re.search(re.escape(option) + r"(?![a-z-])", known):
        faults.append(f"names {option}, which the command line does not have")
for shortcoming in figures["shortcomings"]:
    if shortcoming[-40:] not in text and unit == "mm":
        faults.append(f"does not say: {shortcoming}")
if not re.search(pattern, html):
    faults.append(f"no '{pattern}'")
print("\n".join(faults))
sys.exit(bool(faults))
