"""What is read of a contact: both members' points and normals meet there, and each result is where its place says."""

import numpy as np

from derive.passes.sample import observation
from tests.derive.small import plan


def read():
    """The sample's contact by name, and all names number by number."""
    made = plan()
    found = {name: np.array(numbers, dtype=float) for name, numbers in observation(made).items()}
    return made, found, [o.name for o in made.observed for _ in o.nodes]


def test_points_meet_and_normals_are_opposite():
    _, found, _ = read()
    assert np.allclose(found["point_pinion_f"], found["point_wheel_f"], atol=1e-12)
    assert np.allclose(found["normal_pinion_f"], -found["normal_wheel_f"], atol=1e-12)


def test_results_of_a_body_are_at_their_places():
    made, _, names = read()
    for body in made.drive.bodies:
        places = made.bodies[body.name]
        tangents = [names[places.at + 3 * k] for k in range(places.parameters)]
        assert tangents == [f"tangent_{q}" for q in body.surface.parameters]
        assert names[places.singular] == f"regular_{body.name}"
        assert [names[at] for at in places.margins] == [f"margin_{body.name}_{m.event}" for m in body.margins]


def test_the_gap_bends_as_both_flanks_do():
    _, found, _ = read()
    assert np.allclose(found["second_form_gap"], -found["second_form_pinion"] - found["second_form_wheel"])
    (smaller, larger), (a, b, c) = found["curvature_gap"], found["second_form_gap"]
    assert np.allclose([smaller, larger], np.linalg.eigvalsh([[a, b], [b, c]]))
    ratio = found["lever_arm_pinion"] / found["lever_arm_wheel"]
    assert np.allclose(found["instantaneous_ratio"], ratio)
