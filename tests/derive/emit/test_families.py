"""The table of families lists a key once, and every drive says which of them are its own."""

import json

from derive import drives
from derive.emit import families


def test_a_key_of_several_drives_stands_there_once():
    listed = [build() for name, build in drives.catalogue().items() if name.startswith("spherical_convex")]
    table = families.table(listed)
    (family,) = table["families"].values()
    places = [(p["table"], p["key"], json.dumps(p, sort_keys=True)) for p in family["parameters"]]
    assert len(set(places)) == len(places)
    for described, drive in zip(family["drives"], listed, strict=True):
        own = [family["parameters"][k]["key"] for k in described["parameters"]]
        assert own == [p.key for p in drive.parameters]


def test_the_text_reads_back_as_the_table():
    build = drives.catalogue(["spherical_convex_spur"])["spherical_convex_spur"]
    table = families.table([build()])
    assert json.loads(families.text(table)) == json.loads(json.dumps(table))
