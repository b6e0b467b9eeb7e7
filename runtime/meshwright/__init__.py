"""meshwright: tooth contact analysis on generated gear meshing equations."""
