"""The program of a drive: the intermediate form between mathematics and printers."""
