"""Pydantic models of a design file, made from the generated descriptions: one source for checks and JSON Schema."""

from functools import cache
from typing import Annotated, Literal

from pydantic import ConfigDict, Field, StrictInt, create_model

from meshwright.design import description as metadata

_STRICT = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)

HAND = Literal["right", "left"]

#: Magnitudes beyond which a number of a design, in the unit of its key, is taken for a mistake: nothing that is made
#: or measured reaches them, and beyond them double precision no longer resolves a contact.
LARGEST = {"mm": 1e9, "um": 1e6, "deg": 360.0, "": 1e5}


def _field(parameter):
    """Type and default of one key: a choice of words, or a number with open bounds in the key's own unit."""
    if parameter["choices"]:
        word = Annotated[Literal[tuple(parameter["choices"])], Field(description=parameter["meaning"])]
        return (word, ...) if parameter["required"] else (word | None, None)
    base = StrictInt if parameter["integer"] else float
    annotated = Annotated[base, Field(description=parameter["meaning"], **bounds(parameter))]
    return (annotated, ...) if parameter["required"] else (annotated | None, None)


def bounds(parameter):
    """Bounds of a number in the unit of its key, by the name of the comparison that holds: ``{"gt": 0.0}``.

    Where the description leaves an end open, it is that of :data:`LARGEST`.
    """
    largest = LARGEST.get(parameter["key_unit"], 1e6)
    found = {"le": largest} | ({"ge": -largest} if parameter["lower"] is None else {})
    if parameter["lower"] is not None:
        found["ge" if parameter["lower_included"] else "gt"] = parameter["lower"] / parameter["factor"]
    if parameter["upper"] is not None:
        found["lt"] = parameter["upper"] / parameter["factor"]
        del found["le"]
    return found


def _material_fields():
    """Elastic constants of both members, or of one; what is left out is that of both, or steel."""
    modulus = Annotated[float, Field(gt=0.0)]
    poisson = Annotated[float, Field(gt=-1.0, lt=0.5)]
    return {
        f"{key}{ending}": (Annotated[kind | None, Field(description=f"{meaning}{of}")], None)
        for key, kind, meaning in (
            ("youngs_modulus_mpa", modulus, "Young's modulus"),
            ("poisson_ratio", poisson, "Poisson's ratio"),
        )
        for ending, of in (("", " of both members"), ("_pinion", " of the pinion"), ("_wheel", " of the wheel"))
    }


def _variant_fields(family):
    """Keys whose words choose the drive within the family."""
    words, fields = {}, {}
    for variant in family.variants.values():
        for place, allowed in variant.items():
            words.setdefault(place, {}).update(dict.fromkeys(allowed))
    for place, allowed in words.items():
        table, key = metadata.table_and_key(place)
        word = Literal[tuple(allowed)]
        default = family.variant_defaults.get(place, ...)
        if default in words:
            word, default = word | None, None  # follows the word of another key
        fields.setdefault(table, {})[key] = (word, default)
    return fields


def _has_required(model):
    return any(field.is_required() for field in model.model_fields.values())


def design_model(family, places=None):
    """The pydantic model of a family's design file."""
    return _design_model(metadata.families(places)[family])


@cache
def _design_model(family):
    tables = {}
    for parameter in family.parameters:
        if parameter["table"] != "flank":
            tables.setdefault(parameter["table"], {})[parameter["key"]] = _field(parameter)
    for table, fields in _variant_fields(family).items():
        tables[table] |= fields
    if family.handed:
        tables["design"]["hand"] = (HAND, family.handed)
    tables["material"] = _material_fields()
    models = {
        name: create_model(f"{family.name}-{name}", __config__=_STRICT, **fields) for name, fields in tables.items()
    }
    flanks = next(p for p in family.parameters if p["table"] == "flank")["choices"]
    others = {
        name: (model, ...) if _has_required(model) else (model, Field(default_factory=model))
        for name, model in models.items()
        if name != "design"
    }
    return create_model(
        family.name,
        __config__=_STRICT,
        drive=(Literal[family.name], ...),
        name=(Annotated[str, Field(max_length=200, pattern=r"^[^\x00-\x1f\x7f-\x9f\u2028\u2029]*$")], ""),
        flank=(Literal[tuple(flanks)], next(iter(flanks))),
        design=(models["design"], ...),
        **others,
    )


def json_schema():
    """JSON Schema of every family's design file."""
    schemas = {family: design_model(family).model_json_schema() for family in metadata.families()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "meshwright design",
        "oneOf": [{"$ref": f"#/$defs/{family}"} for family in schemas],
        "$defs": schemas,
    }


def keys(family, places=None):
    """Keys of a family as plain data, for ``meshwright drives``."""
    model = design_model(family, places).model_json_schema()
    definitions = model.pop("$defs")
    listed = []
    for name, definition in definitions.items():
        table = name.removeprefix(f"{family}-")
        required = definition.get("required", [])
        for key, entry in definition["properties"].items():
            listed.append(
                {
                    "table": table,
                    "key": key,
                    "required": key in required,
                    "meaning": _of(entry, "description", ""),
                    "words": _of(entry, "enum", []),
                }
            )
    return listed


def _of(entry, property_name, default):
    """A property of a key's schema, or of the first alternative that has it."""
    return next((e[property_name] for e in (entry, *entry.get("anyOf", [])) if property_name in e), default)
