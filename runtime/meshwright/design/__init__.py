"""From a design file to a checked, completed parameter vector."""
