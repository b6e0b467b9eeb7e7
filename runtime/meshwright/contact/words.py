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
    "not_first": "the bounded flanks touch elsewhere before this tangency, on an edge: bodies cannot make it",
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


def flag(word):
    """A flag in words."""
    return FLAGS.get(word, word.replace("_", " "))
