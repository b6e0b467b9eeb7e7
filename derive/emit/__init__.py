"""Printers: one tape, several languages."""
