"""Numbers and units as text."""

import math

#: How the unit at the end of a key is written, longest first.
_UNITS = (
    ("_mm_per_rad2", "mm/rad²"),
    ("_mm_per_rad", "mm/rad"),
    ("_per_mm", "1/mm"),
    ("_arcmin", "′"),
    ("_arcsec", "″"),
    ("_deg", "°"),
    ("_um", "µm"),
    ("_mm", "mm"),
)

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def unit(key):
    """The unit that a key's last part names; "–" for a pure number."""
    return next((sign for suffix, sign in _UNITS if key.endswith(suffix)), "–")


def title(key):
    """A key as words, without its unit: ``wheel_pitch_radius_mm`` → "wheel pitch radius"."""
    stem = next((key.removesuffix(suffix) for suffix, _ in _UNITS if key.endswith(suffix)), key)
    return stem.replace("_", " ")


def number(value, digits=6):
    """A number with ``digits`` significant digits, true minus sign; "–" where there is none."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == round(value) and abs(value) < 1e9:
        return f"{value:.0f}".replace("-", "−")
    text = f"{value:.{digits}g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        return f"{mantissa} × 10{str(int(exponent)).translate(_RAISED)}".replace("-", "−")
    return text.replace("-", "−")


def fixed(value, decimals):
    """A number with a fixed number of decimals; "–" where there is none."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value:.{decimals}f}".replace("-", "−")
    return text.removeprefix("−") if not text.strip("−0.") else text
