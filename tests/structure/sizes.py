"""Sizes of files and functions."""

import ast
import pathlib
import re

FILE_USUAL, FILE_MOST = 500, 600
FUNCTION_USUAL, FUNCTION_MOST = 60, 100
# clang-format puts the brace of a function, and of nothing else, alone on its line.
OPENING = re.compile(r"^( *)\{$")


def cpp_functions(text):
    """(line of the opening brace, number of lines) for each function of a file laid out by clang-format."""
    lines = text.splitlines()
    number = 0
    while number < len(lines):
        match = OPENING.match(lines[number])
        if match:
            closing = match[1] + "}"
            end = number + 1
            while end < len(lines) and not (lines[end].startswith(closing)):
                end += 1
            yield number + 1, end - number + 1
            number = end
        number += 1


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.lineno, node.end_lineno - node.lineno + 1


def check_sizes(root, warn=lambda line: None):
    """Yields what is beyond the bounds; `warn` gets what is beyond the usual."""
    root = pathlib.Path(root)
    for top in ("engine", "materials", "importers", "plugins", "tests", "samples"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".h", ".cpp", ".py"):
                continue
            text, place = file.read_text(errors="replace"), file.relative_to(root)
            lines = text.count("\n")
            if lines > FILE_MOST:
                yield f"{place}: {lines} lines; split it (at most {FILE_MOST})"
            elif lines > FILE_USUAL:
                warn(f"{place}: {lines} lines (usual: up to {FILE_USUAL})")
            functions = python_functions if file.suffix == ".py" else cpp_functions
            for start, size in functions(text):
                if size > FUNCTION_MOST:
                    yield f"{place}:{start}: a function of {size} lines; split it (at most {FUNCTION_MOST})"
                elif size > FUNCTION_USUAL:
                    warn(f"{place}:{start}: a function of {size} lines (usual: up to {FUNCTION_USUAL})")
