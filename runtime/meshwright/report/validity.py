"""What the numbers of a report leave out."""

#: What the numbers of every report leave out.
VALIDITY = (
    "The teeth are rigid and the flanks are the exact surfaces of their tools: no load, no bending, no wear, no "
    "manufacturing error other than the misalignments of the design.",
    "Contact ellipses are where the quadratic approximation of the gap equals the separation of the design; the "
    "separation is the total normal distance between the bodies.",
    "A limit of the blank that the design does not give is not applied; a window that nothing limits has no end.",
    "The wheel follows the pair that leads. Where a flank has ended at a tip or a face, its edge may go on to touch: "
    "that is in the curve of rigid teeth only, not in the other numbers.",
    "A misalignment is applied alone, on top of those of the design: curves and peak-to-peak values are of the whole "
    "analysis with a step of it either way, changes for one step are by exact derivatives. These may be scaled, "
    "peak-to-peak values may not.",
)
