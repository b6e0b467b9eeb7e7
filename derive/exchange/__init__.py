"""Exchange of designs with other programs: which attribute of a neutral file holds which key of a family."""
