"""Reads what CalculiX wrote: ``.dat`` tables and ASCII ``.frd`` fields.

Both have fixed columns and are cut there: neighbouring numbers touch when they are negative.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshwright.fe.hexahedra import Floats, Ints


@dataclass(frozen=True)
class NodalField:
    """One ``.frd`` field: names of the components, node numbers (K,), values (K, C)."""

    components: tuple[str, ...]
    nodes: Ints
    values: Floats

    def at(self, nodes: Ints) -> Floats:
        """Values (K, C) at given node numbers; a node that the field lacks gives NaN."""
        order = np.argsort(self.nodes)
        place = np.clip(np.searchsorted(self.nodes, nodes, sorter=order), 0, len(order) - 1)
        rows = order[place]
        values = self.values[rows].copy()
        values[self.nodes[rows] != nodes] = np.nan
        return values


def read_frd(path: Path) -> dict[str, NodalField]:
    """The fields of the last step written, by name (``DISP``, ``STRESS``, ``CONTACT``, …)."""
    fields: dict[str, NodalField] = {}
    name = ""
    components: list[str] = []
    rows: list[str] = []
    for line in path.read_text(errors="replace").splitlines():
        key = line[:3]
        if key == " -4":
            name, components, rows = line[5:13].strip(), [], []
        elif key == " -5" and name:
            if line[5:13].strip() != "ALL":
                components.append(line[5:13].strip())
        elif key == " -1" and name:
            rows.append(line)
        elif key == " -3" and name:
            fields[name] = _field(tuple(components), rows)
            name = ""
    return fields


def _field(components: tuple[str, ...], rows: list[str]) -> NodalField:
    nodes = np.array([int(row[3:13]) for row in rows], dtype=np.int64)
    columns = range(13, 13 + 12 * len(components), 12)
    values = [[_number(row[start : start + 12]) for start in columns] for row in rows]
    return NodalField(components, nodes, np.array(values).reshape(len(rows), len(components)))


def _number(text: str) -> float:
    """A Fortran real; an overflow (``***``) or a blank is not a number."""
    try:
        return float(text)
    except ValueError:
        return float("nan")


@dataclass(frozen=True)
class DatTable:
    """One block of the ``.dat`` file.

    quantity is CalculiX's own word (``displacements``, ``forces``, ``stresses``), numbers (K,) the node or element
    numbers, values (K, C); stresses have one row for each integration point, in order, as xx yy zz xy yz zx.
    """

    quantity: str
    set_name: str
    numbers: Ints
    values: Floats


# The .dat file has xx yy zz xy xz yz, everything else xx yy zz xy yz zx.
_STRESS_ORDER = (0, 1, 2, 3, 5, 4)
_HEADER = re.compile(r"^ (displacements|forces|stresses) \(.*\) for set (\S+) and time", re.IGNORECASE)


def read_dat(path: Path) -> dict[tuple[str, str], DatTable]:
    """The tables of the last step written, by (quantity, set name in capitals)."""
    tables: dict[tuple[str, str], DatTable] = {}
    header: tuple[str, str] | None = None
    rows: list[str] = []
    for line in [*path.read_text(errors="replace").splitlines(), " end"]:
        if line.startswith(" ") and line[1:2].isalpha():
            if header:
                tables[header] = _table(*header, rows)
            found = _HEADER.match(line)
            header, rows = ((found[1].lower(), found[2].upper()) if found else None), []
        elif line.strip():
            rows.append(line)
    return tables


def _table(quantity: str, set_name: str, rows: list[str]) -> DatTable:
    label_end, order = (14, _STRESS_ORDER) if quantity == "stresses" else (10, (0, 1, 2))
    columns = [label_end + 14 * component for component in order]
    numbers = np.array([int(row[:10]) for row in rows], dtype=np.int64)
    values = np.array([[_number(row[start : start + 14]) for start in columns] for row in rows])
    return DatTable(quantity, set_name, numbers, values.reshape(len(rows), len(order)))
