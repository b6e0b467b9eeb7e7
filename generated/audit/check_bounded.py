#!/usr/bin/env python3
"""Runs checker/check_bounded.py, which says what it checks; Python's standard library is enough."""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))

from checker.check_bounded import main  # noqa: E402

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
