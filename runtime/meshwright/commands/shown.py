"""What the text output of several commands has in common: numbers without round-off, what was assumed."""

#: Lengths in mm, angles in deg and pure numbers below this are round-off of a solved point.
ROUND_OFF = 1e-9


def shown(value, unit="", round_off=ROUND_OFF):
    """A number with six significant digits and its unit; "–" where there is none, 0 below ``round_off``."""
    if value is None:
        return "–"
    return f"{0.0 if abs(value) < round_off else value:.6g} {unit}".strip()


def blank_note(assumed):
    """A line that says what of the blank is a standard proportion, empty where the design gives all of it."""
    sizes = ", ".join(f"{key} = {value:.6g}" for key, value in assumed.items())
    return f"assumed where [blank] is open: {sizes}\n" if sizes else ""
