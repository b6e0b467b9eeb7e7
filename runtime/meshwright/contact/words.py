"""Status words, flags and events of results, in plain words."""

#: What each flag of a contact point means, for a reader; whether bodies can make such a point is the library's word.
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
    "not_first": "the bounded flanks touch elsewhere before this tangency, on an edge",
}

#: What ends a contact window, or an edge of a flank.
EVENTS = {
    "tip": "the contact reaches the tip of a member",
    "throat": "the contact reaches the throat of the wheel",
    "face": "the contact reaches the end of the face",
    "root": "the contact reaches the root of a member",
    "tool_end": "the contact reaches what the end of the cutting tool has cut",
    "undercut": "the contact reaches the undercut line: beyond it the flank is cut away",
    "regression": "the contact reaches an edge of regression: beyond it the flank does not exist",
    "fold": "the branch of contact turns back: two contacts merge and vanish",
    "none": "nothing that the design gives limits the contact",
}

#: Quantities of results, as `meshwright explain` says them; rigid, unloaded teeth unless they say otherwise.
QUANTITIES = {
    "contact_ratio": "over how many pitches one pair touches, from begin to end of its contact. Teeth that touch in a "
    "point follow the path of that point: of helical teeth less than the total contact ratio of ISO 21771, which "
    "counts contact lines",
    "teeth_in_contact": "how many pairs are inside their contact at once, averaged; an elastic allowance adds those "
    "that stand no further apart",
    "transmission_error": "wheel angle less pinion angle over gear ratio; relative: less its value at the reference "
    "angle",
    "envelope": "the error of the drive: at every angle that of the pair which leads, the others stand apart",
    "transfer_angle": "where the errors of two pairs are equal and the next pair takes over; outside of their contact "
    "it does not, and pairs change where one ends",
    "vertex": "where the error of a pair is stationary",
    "backlash": "how far the wheel turns between contact on this flank and on the other, pinion held",
    "self_locking_friction": "coefficient of friction from which the wheel cannot drive the pinion: where it is least "
    "along the path, and from which it cannot anywhere",
    "ellipse": "where the unloaded flanks stand no further apart than the separation of the design: semi-axes "
    "sqrt(2 separation / relative curvature)",
    "ease_off": "how far a flank stands back from the surface that its mate would envelop at a constant ratio",
    "first_contact": "where the bounded flanks, edges included, meet first as the wheel turns towards the pinion",
}


def flag(word):
    """A flag in words."""
    return FLAGS.get(word, word.replace("_", " "))
