"""A drive inside other software: tables of its error, components of FMI, packages of other languages."""
