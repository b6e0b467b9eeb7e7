"""Flags and limits of validity in plain words."""

#: What each flag of a contact point means, for a reader.
FLAGS = {
    "undercut": "the point lies past an undercut line: that part of the flank is cut away",
    "interference": "the flanks would cut into each other here (negative relative curvature)",
    "beyond_regression": "the point lies beyond an edge of regression: that part of the flank does not exist",
    "spurious_sheet": "the point lies on a sheet that satisfies the equations but is no part of the tooth",
    "off_tip": "the point lies outside a tip",
    "off_root": "the point lies below a root",
    "off_face": "the point lies outside a face",
    "off_tool": "the point lies beyond the end of the cutting tool",
    "edge_contact": "an edge of a tooth touches, not its flank",
}

#: What the numbers of every report leave out.
VALIDITY = (
    "The teeth are rigid and the flanks are the exact surfaces of their tools: no load, no bending, no wear, no "
    "manufacturing error other than the misalignments of the design.",
    "Contact ellipses are where the quadratic approximation of the gap equals the separation of the design; the "
    "separation is the total normal distance between the bodies.",
    "A limit of the blank that the design does not give is not applied; a window that nothing limits has no end.",
    "The wheel follows the pair that leads. Where a flank has ended at a tip or a face, its edge may go on to touch: "
    "that is in the curve of rigid teeth only, not in the other numbers.",
    "A misalignment is applied alone, on top of those of the design, and its effect is a central difference: "
    "proportional effects may be scaled, peak-to-peak values may not.",
)


def flag(word):
    """A flag in words."""
    return FLAGS.get(word, word.replace("_", " "))
