"""Many samples of one design: plans, slices of results, statistics."""
