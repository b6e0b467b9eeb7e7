"""List the families of drives, their keys and the packaged designs."""

from meshwright.base.files import write_json, write_text
from meshwright.design import description as metadata
from meshwright.design import design, schema


def add_arguments(parser):
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON")


def run(options):
    families = [
        {"name": family, "keys": schema.keys(family), "designs": _designs(family)} for family in metadata.families()
    ]
    if options.json:
        write_json(options.json, {"families": families})
    else:
        write_text("-", "\n".join(map(_page, families)))
    return 0


def _designs(family):
    return [name for name in design.packaged_names() if design.read(name)["drive"] == family]


def _page(family):
    lines = [family["name"], "  packaged designs"]
    lines += [f"    {name}" for name in family["designs"]]
    for table in dict.fromkeys(key["table"] for key in family["keys"]):
        lines.append(f"  [{table}]")
        for key in family["keys"]:
            if key["table"] == table:
                mark = "required" if key["required"] else ""
                said = ": ".join(filter(None, [key["meaning"], " | ".join(map(str, key["words"]))]))
                lines.append(f"    {key['key']:<34} {mark:<9} {said}".rstrip())
    return "\n".join(lines) + "\n"
