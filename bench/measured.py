"""Sections of pages that are measured: between `<!-- measured: NAME -->` and `<!-- end -->`."""
import re
import sys

SECTION = re.compile(r"<!-- measured: ([\w-]+) -->\n(.*?)<!-- end -->\n", re.S)


def sections_of(text):
    """{name: what stands there}"""
    return dict(SECTION.findall(text))


def write(page, sections):
    """Puts each of `sections` in its place on the page."""
    with open(page, encoding="utf-8") as file:
        text = file.read()
    missing = sections.keys() - sections_of(text).keys()
    if missing:
        sys.exit(f"{page}: no section {', '.join(sorted(missing))}")
    text = SECTION.sub(lambda m: f"<!-- measured: {m[1]} -->\n{sections.get(m[1], m[2])}<!-- end -->\n", text)
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)
