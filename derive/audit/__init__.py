"""The audit record.

What the sources print, what we derive, what was proved of it, and which generated files rest on it.
"""
