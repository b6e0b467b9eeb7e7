"""Values of attributes: text of a file ↔ numbers in inner units (mm, rad), with unit, type, range and words checked."""

import math
import re

from meshwright.rexs.document import RexsError

#: Units of attributes that hold a key, with the factor to the inner unit.
FACTORS = {"mm": 1.0, "mum": 1e-3, "deg": math.pi / 180.0, "rad": 1.0, "none": 1.0}

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_SCALAR = {"floating_point": (_NUMBER, "a number"), "integer": (r"[-+]?\d+", "a whole number")}


def element_of(place, component, spec):
    """The element of an attribute, None if the file has none; its unit is checked."""
    element = component.attributes.get(spec["attribute"])
    if element is None:
        return None
    unit = element.attributes.get("unit", "none" if spec["unit"] == "none" else "")
    if unit != spec["unit"]:
        raise _error(place, component, spec, f"unit {unit!r}", f"REXS has it in {spec['unit']!r}: convert it")
    return element


def number(place, component, spec):
    """The number of an attribute in its inner unit, or a tuple of those of an array; None if the file has none."""
    element = element_of(place, component, spec)
    if element is None:
        return None
    if spec["type"] == "floating_point_array":
        arrays = element.all("array")
        if len(arrays) != 1 or not arrays[0].all("c"):
            raise _error(place, component, spec, "not an array", "write <array><c>…</c>…</array>")
        entries = tuple(_number(place, component, spec, c.text, "floating_point") for c in arrays[0].all("c"))
        if len(entries) != len(spec["value"]):
            raise _error(place, component, spec, f"{len(entries)} entries", f"it has {len(spec['value'])}")
        return entries
    if element.children:
        raise _error(place, component, spec, "not a single number", "write the number alone")
    return _number(place, component, spec, element.text, spec["type"])


def _number(place, component, spec, text, kind):
    pattern, wanted = _SCALAR[kind]
    text = text.strip()
    if len(text) > 100 or not re.fullmatch(pattern, text, re.ASCII) or not math.isfinite(value := float(text)):
        raise _error(place, component, spec, f"= {text[:60]!r} is not {wanted}", "write a finite number with a point")
    if reason := out_of_range(spec, value):
        raise _error(place, component, spec, f"= {text} {reason}", "correct the value")
    return value * FACTORS[spec["unit"]]


def out_of_range(spec, value):
    """Why REXS does not allow a number (in the attribute's unit), empty if it does."""
    lower, upper = spec.get("lower"), spec.get("upper")
    if lower is not None and (value < lower or (spec["lower_open"] and value == lower)):
        return f"must be {'above' if spec['lower_open'] else 'at least'} {lower:g}"
    if upper is not None and (value > upper or (spec["upper_open"] and value == upper)):
        return f"must be {'below' if spec['upper_open'] else 'at most'} {upper:g}"
    return ""


def word(place, component, spec):
    """The word of the design that an attribute means; None if the file has none."""
    element = element_of(place, component, spec)
    if element is None:
        return None
    meant = {theirs: ours for ours, theirs in spec["words"].items()}
    if (text := element.text.strip()) not in meant:
        known = ", ".join(spec["enum"])
        raise _error(place, component, spec, f"= {text[:60]!r} is not one of its words", f"use one of {known}")
    return meant[text]


def _error(place, component, spec, reason, remedy):
    return RexsError(f"{place}, {component}, attribute {spec['attribute']}", reason, remedy)


def converted(inner, factor):
    """A number in the unit that has this factor to the inner one.

    Where a factor is applied, of the numbers within two steps of double precision that of 15 digits: round numbers stay
    round.
    """
    if factor == 1.0:
        return inner
    value = inner / factor
    rounded = float(f"{value:.15g}")
    return rounded if abs(rounded - value) <= 2.0 * math.ulp(value) else value


def in_unit(spec, inner):
    """A number in the unit of its attribute."""
    return converted(inner, FACTORS[spec["unit"]])


def text_of(spec, value):
    """A number, in the attribute's unit, as text."""
    return str(round(value)) if spec["type"] == "integer" else repr(value)
