"""What a drive says of its solid teeth: sizes of a member, and the drive of either flank."""

from meshwright.contact.functions import has
from meshwright.design import design as designs
from meshwright.drive import Drive
from meshwright.fe.tooth import SideName


def solid_sizes(drive: Drive, member: str) -> dict[str, float]:
    """Results of the drive's function ``solid_<member>`` as numbers by name, inner units; {} if there is none."""
    name = f"solid_{member}"
    return {key: float(value) for key, value in drive.function(name)().items()} if has(drive, name) else {}


def body_of(drive: Drive, member: str) -> dict:
    """The description of a member."""
    return next(body for body in drive.design.description["bodies"] if body["name"] == member)


def key_of(drive: Drive, name: str) -> str:
    """The design key ("table.key") of a size that messages speak of."""
    return drive.design.description["loading"]["keys"][name]


def other_flank(drive: Drive) -> Drive:
    """The drive of the other flank; where flanks have designs of their own, the packaged partner if there is one."""
    own, other = drive.design.tables["flank"], drive.design.other_flank
    named = drive.design.tables["name"]
    partner = named.replace(own, other)
    if drive.design.description["flanks_apart"] and partner != named and partner in designs.packaged_names():
        return Drive.load(partner)
    return drive.with_(flank=other)


def flank_pair(drive: Drive) -> dict[SideName, Drive]:
    """The drives of the flank of sign +1, called left, and of the other."""
    if drive.design.flank > 0:
        return {"left": drive, "right": other_flank(drive)}
    return {"left": other_flank(drive), "right": drive}
