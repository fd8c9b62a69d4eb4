"""Processes that are not children of the tests."""

import pathlib


def alive(pid):
    """Whether a process runs; one that waits to be buried does not."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False
