"""Parameters of which some are tried by ``make test`` and the others by ``make validate``."""

import os

import pytest

#: One packaged design of each kind of blank; every other one is looked at by the longer validation.
ONE_OF_A_KIND = (
    "bevel-face-hobbed", "bevel-formate", "bevel-hypoid", "crossed-helical-17-23", "face-worm-cylindrical-concave",
    "helical-crowned", "plain-zc", "plain-zi", "plain-zk", "plain-zn", "recess-action-full",
    "spherical-table-2-2-convex-14-5", "spherical-table-4-4-concave", "spherical-table-5-2-spur",
    "spur-profile-shift", "zk-zn-60",
)  # fmt: skip


def quick(values, *now):
    """The values as parameters of a test; all but those of ``now`` are marked ``validate``."""
    return [pytest.param(*_listed(v), marks=[] if v in now else [pytest.mark.validate]) for v in values]


def some(values, *kept):
    """Those of the values that are ``kept``, all with ``SIZE=full``: parameters of a test that takes long for each."""
    return list(values) if full() else [v for v in values if v in kept]


def full():
    """Whether the sizes are those of ``make validate SIZE=full``: hours, not minutes."""
    return os.environ.get("MESHWRIGHT_SIZE") == "full"


def _listed(value):
    return value if isinstance(value, tuple) else (value,)
