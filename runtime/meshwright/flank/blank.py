"""A drive with a whole blank, for what needs one."""

from meshwright.base.errors import DesignError


def with_whole_blank(drive):
    """The drive with its whole blank, what of it was assumed, and why the standard proportions do not fit or ""."""
    try:
        whole, assumed = drive.design.with_whole_blank()
    except DesignError as error:
        return drive, {}, str(error)
    return (drive.of_design(whole) if assumed else drive), assumed, ""
