"""Making and measuring: nominal grids, sizes over balls, measured flanks, identification of errors, wear of a tool."""
