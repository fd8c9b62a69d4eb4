#!/usr/bin/env python3
"""check.py ROOT [includes|sizes|top_level|links|words ...]: prints what breaks the rules of the house; status 1 if any."""

import sys

from includes import check_includes
from sizes import check_sizes
from texts import check_links, check_top_level, check_words

CHECKS = {
    "includes": check_includes,
    "sizes": lambda root: check_sizes(root, warn=lambda line: print(f"warning: {line}")),
    "top_level": check_top_level,
    "links": check_links,
    "words": check_words,
}


def main(arguments):
    root, chosen = arguments[0], arguments[1:] or CHECKS
    findings = 0
    for name in chosen:
        for line in CHECKS[name](root):
            print(f"{name}: {line}")
            findings += 1
    print(f"{findings} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
