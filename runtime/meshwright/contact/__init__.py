"""Contact of one tooth pair at given angles: analysis, results, branches, placement, sensitivities, CasADi."""
