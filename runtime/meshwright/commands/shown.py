"""Numbers in text output: what is round-off is written as zero."""

#: Lengths in mm, angles in deg and pure numbers below this are round-off of a solved point.
ROUND_OFF = 1e-9


def shown(value, unit="", round_off=ROUND_OFF):
    """A number with six significant digits and its unit; "–" where there is none, 0 below ``round_off``."""
    if value is None:
        return "–"
    return f"{0.0 if abs(value) < round_off else value:.6g} {unit}".strip()
