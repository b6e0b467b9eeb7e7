"""Files with random damage: read, or refused with an error that names the file; never anything else."""

import random

import pytest

from meshwright.rexs.document import RexsError, parsed
from meshwright.rexs.reading import design_of
from meshwright.rexs.writing import file_of
from tests.rexs.designs import FORMATE, HELICAL, file_text, named, worm_pair

PIECES = (
    b"", b"<", b">", b'"', b"&", b"-", b"0", b"9e99", b"1e400", b"nan", b"\xff", b'id="2"', b"mm", b"<c/>",
    b"<array/>", b"</component>",
)  # fmt: skip


def damaged(source, chance):
    """The bytes with one to three pieces replaced."""
    source = bytearray(source)
    for _ in range(chance.randint(1, 3)):
        at = chance.randrange(len(source))
        source[at : at + chance.choice((0, 0, 1, 2, 5, 40))] = chance.choice(PIECES)
    return bytes(source)


@pytest.mark.parametrize("tables", [worm_pair("ZC", "ZA"), HELICAL, FORMATE], ids=named)
def test_damage_is_survived_or_named(tables):
    chance, source, survived = random.Random(named(tables)), file_text(tables).encode(), 0
    for _ in range(250):
        try:
            document = parsed(damaged(source, chance), "FILE.rexs")
            read = design_of(document)
        except RexsError as error:
            assert str(error).startswith("FILE.rexs")
        else:
            survived += 1
            again = design_of(parsed(file_of(read.tables, "0", document).content, "FILE.rexs"))
            assert again.tables.keys() == read.tables.keys()
            assert all(again.tables[name] == pytest.approx(entries) for name, entries in read.tables.items())
    assert 0 < survived < 250
