"""The mesh cycle of a pair and of its neighbours: path, windows, transmission error, edges, backlash."""
