"""Passes: what turns a description into a program and one program into the next, one file each."""
