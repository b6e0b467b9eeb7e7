"""A drive's shared object through ctypes, without the Python package. Argument: path of cylindrical_worm_zn_zn.so."""

import ctypes
import math
import sys

ABI = 1


class Info(ctypes.Structure):
    _fields_ = [(name, ctypes.c_int) for name in ("status", "iterations", "guard")]
    _fields_ += [(name, ctypes.c_double) for name in ("step", "residual", "rank_gap")]


library = ctypes.CDLL(sys.argv[1])
if library.mw_abi() != ABI:
    sys.exit(f"{sys.argv[1]} has ABI {library.mw_abi()}, this program needs ABI {ABI}")
library.mw_drive_cylindrical_worm_zn_zn.restype = ctypes.c_void_p
drive = ctypes.c_void_p(library.mw_drive_cylindrical_worm_zn_zn())
p = (ctypes.c_double * 64)(*[math.nan] * 64)
for place, value in {1: 2, 3: 1, 4: 277, 5: math.radians(3), 7: math.radians(10), 9: 4, 10: 20.063824}.items():
    p[place] = value
s, work, x, info = (ctypes.c_double * 512)(), (ctypes.c_double * 128)(), (ctypes.c_double * 8)(), Info()
library.mw_complete(drive, p, work, ctypes.byref(info))
status = library.mw_solve(drive, p, ctypes.c_double(7.0), s, work, x, ctypes.byref(info))
print(f"status {status}, transmission error {math.degrees(x[4]) * 3600:.6f} arcsec")
sys.exit(status != 0)
