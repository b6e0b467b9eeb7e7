"""The whole record: which chapters there are, and the ledger built from them."""

from __future__ import annotations

from functools import cache

from derive.audit.documents import face_worm, rack_and_pinion, recess_action, spherical, zk_zn
from derive.audit.identities import conventions, cylindrical_worm, helicoids
from derive.audit.identities import face_worm as face_worm_drives
from derive.audit.identities import spherical as spherical_gears
from derive.audit.ledger import Chapter, Ledger, build


def chapters() -> list[Chapter]:
    """Sources in reading order, then our own identities."""
    sources = (recess_action, rack_and_pinion, zk_zn, spherical, face_worm)
    identities = (conventions, helicoids, cylindrical_worm, spherical_gears, face_worm_drives)
    return [module.CHAPTER for module in (*sources, *identities)]


@cache
def ledger() -> Ledger:
    """The record, built once a process."""
    return build(chapters())
