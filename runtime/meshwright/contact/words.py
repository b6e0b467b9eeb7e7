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

#: Why a proof over a range of angles has a gap, beside the reasons of single proofs.
GAPS = {
    "tube": "the transmission error cannot be enclosed as narrowly as the bounds of a window need",
    "joint": "two pieces of the branch cannot be shown to be one where they meet",
    "no_line": "the flanks do not touch along a line, or change at an end of it",
    "elsewhere_first": "another place of the two flanks touches before the line",
}

#: Outcomes of proofs.
OUTCOMES = {
    "unique": "proved: the contact exists and is the only one nearby",
    "enclosed": "proved: the flanks touch first between two errors; of a line: all along it they lie within so much of "
    "one another",
    "first": "proved: nothing else of the flanks touches before it",
    "unknown": "neither is proved, for the reason that stands beside it: this says nothing against the contact",
}

#: Quantities of results, as `meshwright explain` says them; rigid, unloaded teeth unless they say otherwise.
QUANTITIES = {
    "gear_ratio": "turns of the pinion to one of the wheel: teeth of the wheel over those of the pinion",
    "pitch": "pinion angle from one pair of teeth to the next",
    "pair": "a tooth of the pinion and the one of the wheel that it meets; the next pair stands a pitch later",
    "pinion_angle": "turn of the pinion, which is given; at 0 the design's tooth pair stands at its reference",
    "wheel_angle": "turn of the wheel at which the flanks touch",
    "transmission_error": "wheel angle less pinion angle over gear ratio; relative: less its value at the reference "
    "angle",
    "relative": "of a transmission error: less its value at the reference angle. Of curvatures: of one flank against "
    "the other, negative where they overlap beside the point",
    "peak_to_peak": "largest less smallest value over the contact of a pair, or over one pitch of the drive",
    "constant_to_round_off": "so even that only the rounding of numbers is left of it",
    "contact_ratio": "over how many pitches one pair touches, from begin to end of its contact. Teeth that touch in a "
    "point follow the path of that point: of helical teeth less than the total contact ratio of ISO 21771, which "
    "counts contact lines. Below 1 a pair has left contact before the next one begins",
    "teeth_in_contact": "how many pairs are inside their contact at once, averaged; an elastic allowance adds those "
    "that stand no further apart",
    "elastic_allowance": "separation below which a pair counts as touching, of the design",
    "separation": "how far flanks stand apart along the normal; the design's is that at which ellipses are drawn",
    "envelope": "the error of the drive: at every angle that of the pair which leads, the others stand apart. Upper or "
    "lower: the largest or the smallest error leads",
    "other_envelope": "the error if the pair that lags led, which rigid teeth do not transmit: the kinematic error of "
    "some papers",
    "edges_included": "what rigid teeth transmit with the edges that touch where no flanks do",
    "with_edges": "see edges_included",
    "transfer_angle": "where the errors of two pairs are equal and the next pair takes over; outside of their contact "
    "it does not, and pairs change where one ends",
    "pairs_change": "where the next pair takes over: see transfer_angle",
    "rides_on_edge": "the pair that leads stands at an end of its contact, so that an edge carries when pairs change",
    "vertex": "where the error of a pair is stationary",
    "tooth_order": "see orders",
    "amplitude": "half the swing of one of the orders",
    "orders": "Fourier components of the transmitted error, by multiples of the frequency of the teeth",
    "backlash": "how far the wheel turns between contact on this flank and on the other, pinion held; negative: the "
    "teeth are thicker than the spaces, and the drive jams",
    "jams": "the backlash is negative: the teeth are thicker than the spaces",
    "room": "which lengths, one at a time, changed by how much, end the overlap of a drive that jams",
    "friction": "coefficient of friction between the flanks, as it was given",
    "efficiency": "power that leaves over power that enters with the friction given, with either member driving",
    "self_locking_friction": "coefficient of friction from which the wheel cannot drive the pinion: where it is least "
    "along the path, and from which it cannot anywhere",
    "begin": "where the contact of a pair begins as the driving pinion turns; an event says what limits it there",
    "end": "where the contact of a pair ends as the driving pinion turns; an event says what limits it there",
    "event": "what limits contact; `meshwright explain` lists the words",
    "member": "pinion or wheel: which of the two a limit or number is of",
    "impossible": "flags of points, between begin and end, that satisfy the equations but that bodies cannot make",
    "status": "how the search for a contact ended; `meshwright explain` lists the words",
    "flags": "what is particular about a contact point; `meshwright explain` lists the words",
    "residual": "what the equations of contact leave at the solution",
    "message": "the status in a sentence",
    "schema": "name and version of what a JSON document holds; keys are never renamed, new ones may be added",
    "iterations": "Newton steps to the solution",
    "contact_point": "where the flanks touch, in the fixed frame or that of the member named",
    "contact_normal": "unit normal at the contact, out of the pinion, fixed frame",
    "major_direction": "direction in which the contact ellipse is longest, fixed frame",
    "curvature": "principal curvatures of one flank against the other; the direction of the smaller one is the long "
    "axis of the ellipse",
    "ellipse": "where the unloaded flanks stand no further apart than the separation of the design: semi-axes "
    "sqrt(2 separation / relative curvature)",
    "semi_major": "half the length of the contact ellipse",
    "semi_minor": "half the width of the contact ellipse",
    "semi_axes": "half the length and half the width of the contact ellipse",
    "lever_arms": "how far a member moves along the contact normal for each radian of its turn",
    "instantaneous_ratio": "speed of the wheel over that of the pinion at this angle",
    "sliding_velocity": "velocity of one flank along the other at the contact, for one radian of the pinion a second",
    "entraining_velocity": "mean velocity of the contact over both flanks, which draws in the lubricant",
    "specific_sliding": "sliding over the velocity of the contact on the flank of the member named",
    "crowning": "a flank that stands back towards its ends or edges, so that contact is a point inside it: keys of "
    "designs, `meshwright drives` lists them",
    "ease_off": "how far a flank stands back from the surface that its mate would envelop at a constant ratio",
    "first_contact": "where the bounded flanks, edges included, meet first as the wheel turns towards the pinion: in a "
    "point inside both (tangency), along a line, on an edge or at a corner",
    "enclosed": "of the error of a line, an edge or a corner: proved that the flanks touch first between two errors",
    "edges": "which edges of the teeth hold a place of first contact; a face has a left and a right end, the right one "
    "at larger z of its member, or a toe and a heel",
    "contact_line": "the line along which flanks, or an edge and a flank, touch: its points, what ends it, its length",
    "curvature_per_mm": "relative curvature of the flanks across the line of contact, at each of its points",
    "transverse_contact_ratio": "over how many pitches a section of a pair across parallel axes touches",
    "overlap_ratio": "what the helix adds to the transverse contact ratio of flanks that touch along lines",
    "backlash_mm": "backlash as a length, on parallel axes: transverse, on the working pitch circles, and normal, "
    "along the line of action",
    "overlap": "how deep an edge would stand in the other flank at the tangency, had it not touched before",
    "kind": "of a first contact: tangency, line, edge or corner; of a branch point: fold, crossing or pitchfork",
    "turned_back": "how far the wheel is turned back from contact while nothing is shown to touch on the way",
    "ended_by_limits": "whether the part of a flank that was looked at ends at the limits of the design",
    "unresolved": "overlap that the search for first contact could have missed",
    "certified": "proved with bounds of every rounding, not only computed: a contact, its only one nearby, and how far "
    "its numbers can be off",
    "pieces": "arcs of the branch of contact, each proved, that cover the window of contact",
    "spans": "ranges of angles of one pair over which one thing is proved, or not, of first contact",
    "neighbours": "what is proved of the pairs before and after",
    "gaps": "ranges of angles over which the proof does not hold",
    "branch_points": "where the branch of contact turns back (fold) or another one crosses it (crossing, pitchfork)",
    "pitchfork": "a branch point at which a branch turns back just where it meets another one",
    "crossing": "a branch point at which two branches of contact meet",
    "first_type": "limit points of the first type: the contact of cutting at which the wheel begins to be undercut",
    "second_type": "limit points of the second type: where the two contacts of cutting that a point of the tool has in "
    "a turn fall together; points beyond never touch",
    "inclination": "angle of an axis of meshing to the axis of the tool",
    "meshing_axes": "lines that the normals at all contacts of a helicoid and what it cuts meet",
    "section_profile": "contact of cutting in one plane, as rack and pinion",
    "tip_thickness": "thickness of a tooth at the tip; below zero its flanks meet before: it is pointed",
    "pointed_teeth": "members both flanks of whose teeth meet below the tip that the design gives, and at which radius",
    "pointed": "the two flanks of a tooth meet in an edge below the tip that the design gives",
    "least_teeth_without_undercut": "the least number of teeth of a member whose flank the tool does not cut away",
    "on_flank": "whether a place lies within every limit of the flank",
    "parameters": "coordinates of a place on a surface; `meshwright explain` knows those of contacts by their names",
    "edge_position": "place on the straight edge of the tool that cuts there",
    "tool_radius": "radius on the tool that cuts there",
    "clearance": "height of a tool above finished teeth that it passes; below zero it cuts into them",
    "assumed_blank": "standard proportions that stand for the sizes of the blank which the design leaves open",
    "not_computed": "limits that this drive does not offer, or that the command was not asked for, with the reason",
    "loaded_transmission_error": "transmission error of elastic teeth under the torque given",
    "load_share": "part of the force that one pair carries",
    "mesh_stiffness": "force along the normals over the approach of the flanks, at the torque given",
    "peak_pressure": "largest contact pressure of a pair; where a sharp edge of a flank presses, that of the free "
    "contact, a quarter of its length and width away, or of the half of the force that is furthest away",
    "peak_at_edge": "pressure is higher beside a sharp edge of a flank than the peak of the free contact: there it "
    "grows without bound as cells get finer; force and share hold",
    "carried_by_edge": "a sharp edge carries half of a pair's force or more: its peak of pressure is as sharp as that",
    "edge_zone": "how far from sharp edges the peak of pressure is taken, along and across the contact",
    "edge_loads": "force, length of the edge and mean pressure beside each sharp edge that presses, to about 5 %",
    "rotation_not_small": "of loaded contact: the torque turns the member too far for linear elasticity",
    "not_resolved": "of loaded contact: finer or wider cells go on changing the result, or it breaks equilibrium",
    "misalignment": "errors of the assembly, keys of [misalignment]; the contact is solved with them as they are",
    "sensitivity": "how much a result changes for a unit of a key, by exact derivatives",
    "drawing_data": "what the drawings of the members and of their assembly state of the nominal design",
    "limits_of_validity": "what the numbers of a report leave out",
    "contact_pattern": "what a marking compound shows: where the flanks come nearer than its thickness over the mesh",
}


def flag(word):
    """A flag in words."""
    return FLAGS.get(word, word.replace("_", " "))
