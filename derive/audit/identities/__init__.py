"""Identities about our own derivations, for generic profiles and angles wherever possible."""
