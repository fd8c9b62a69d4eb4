"""The top level, links in the documentation, and words that must not stay in a text."""

import pathlib
import re

REQUIRED = {"README.md", "CMakeLists.txt", "importers", "materials", "engine", "plugins", "tests", "samples"}
BESIDE = {"LICENSE", "CMakePresets.json", "out"}
SOURCES = ("engine", "materials", "importers", "plugins", "tests", "samples")
TEXT_SUFFIXES = {".h", ".cpp", ".py", ".md", ".txt", ".toml", ".sh", ".cmake", ".rad", ""}

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)[^)]*\)|<img[^>]*\bsrc=\"([^\"]+)\"")
# Put together, so that this file does not contain them.
WORDS = [re.compile(pattern) for pattern in
         (r"\bTO" r"DO\b", r"\bFIX" r"ME\b", r"\bX" r"XX\b", r"\bHA" r"CK\b", r"(?i)\bfor n" r"ow\b", r"(?<![\w.])/wo" r"rk/")]


def check_top_level(root):
    entries = {p.name for p in pathlib.Path(root).iterdir() if not p.name.startswith(".")}
    for name in sorted(REQUIRED - entries):
        yield f"{name}: missing at the top level"
    for name in sorted(entries - REQUIRED - BESIDE):
        if not name.startswith("build"):
            yield f"{name}: does not belong to the top level (README.md has the map)"


def _anchors(markdown):
    """The names under which the headings of a page can be linked."""
    for heading in re.findall(r"^#+\s+(.*)$", markdown, re.MULTILINE):
        plain = re.sub(r"[`*]", "", heading).strip().lower()
        yield re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", plain))


def check_links(root):
    """Yields each link of a *.md to a file or heading that does not exist; the web is not asked."""
    root = pathlib.Path(root)
    pages = [root / "README.md"] + [p for top in SOURCES for p in sorted((root / top).rglob("*.md"))]
    for page in (p for p in pages if p.exists()):
        text = re.sub(r"^```.*?^```", lambda m: "\n" * m[0].count("\n"), page.read_text(), flags=re.M | re.S)
        for number, line in enumerate(text.splitlines(), 1):
            for first, second in LINK.findall(line):
                target, _, anchor = (first or second).partition("#")
                if re.match(r"[a-z]+:", target):
                    continue
                file = (page.parent / target) if target else page
                place = f"{page.relative_to(root)}:{number}"
                if not file.exists():
                    yield f"{place}: dead link to {target}"
                elif anchor and file.suffix == ".md" and anchor not in _anchors(file.read_text()):
                    yield f"{place}: no heading #{anchor} in {target or page.name}"


def check_words(root):
    root = pathlib.Path(root)
    files = [p for p in root.iterdir() if p.is_file() and not p.name.startswith(".git")]
    files += [p for top in SOURCES for p in sorted((root / top).rglob("*")) if p.is_file()]
    for file in files:
        if file.suffix not in TEXT_SUFFIXES or file.name == "LICENSE" or "__pycache__" in file.parts:
            continue
        for number, line in enumerate(file.read_text(errors="replace").splitlines(), 1):
            for word in WORDS:
                match = word.search(line)
                if match:
                    yield f"{file.relative_to(root)}:{number}: \"{match[0]}\": finish it or drop it"
