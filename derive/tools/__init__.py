"""Generating tools: one file each."""
