"""What a measuring machine is to find: nominal points of one or both flanks of some teeth, with outward normals."""

import math

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import about_z
from meshwright.shop.tables import Points


def nominal(drive, member, lines, margin, teeth=(1,), flanks=None):
    """:class:`~meshwright.shop.tables.Points` of a member's flanks within their evaluation limits, body frame.

    ``lines`` are N across × M along the tooth, ``margin`` the share of the lengths that is left out at each end.
    ``teeth`` are numbers from 1 on: tooth k is the drawn one turned by (k − 1)/T of a turn about +z. ``flanks`` are
    words, the design's own by default. Places of the grid where the tooth has no flank are left out.
    """
    count = drive.teeth(member)
    for tooth in teeth:
        if not 1 <= tooth <= count:
            raise UsageError(f"--teeth {tooth}: the {member} has teeth 1 to {count}; name one of them")
    parts = []
    for word in flanks or (drive.design.tables["flank"],):
        found = of_flank(drive, word).surface(member, lines, inset=margin)
        index = np.argwhere(np.isfinite(found.points).all(axis=1).reshape(lines))
        rows = index[:, 0] * lines[1] + index[:, 1]
        for tooth in teeth:
            turn = about_z(2.0 * math.pi * (tooth - 1) / count)[:3, :3]
            parts.append((tooth, word, index, found.points[rows] @ turn.T, found.normals[rows] @ turn.T))
    sizes = [len(index) for _, _, index, _, _ in parts]
    index = np.concatenate([part[2] for part in parts])
    return Points(
        np.repeat([part[0] for part in parts], sizes),
        tuple(word for (_, word, *_), size in zip(parts, sizes, strict=True) for _ in range(size)),
        index[:, 0], index[:, 1],
        np.concatenate([part[3] for part in parts]), np.concatenate([part[4] for part in parts]),
        np.full(sum(sizes), np.nan),
    )  # fmt: skip


def flank_words(drive):
    """The words of a drive's two flanks."""
    return tuple(next(p["choices"] for p in drive.design.description["parameters"] if p["table"] == "flank"))


def of_flank(drive, word):
    """The drive with the flank of that word; where each flank is a design of its own, only the design's."""
    if word == drive.design.tables["flank"]:
        return drive
    if word not in flank_words(drive):
        raise UsageError(f"flank = {word!r}: the flanks of this drive are {', '.join(flank_words(drive))}; name one")
    if drive.design.description["flanks_apart"]:
        raise UsageError(
            f"flank = {word!r}: each flank of this drive is a design of its own; use the design with that flank"
        )
    return drive.with_(flank=word)


