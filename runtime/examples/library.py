"""A drive's shared object through ctypes, without the Python package. Argument: path of cylindrical_worm_zn_zn.so."""

import ctypes
import math
import re
import sys
from pathlib import Path

ABI = 7


class Info(ctypes.Structure):
    _fields_ = [(name, ctypes.c_int) for name in ("status", "iterations", "guard")]
    _fields_ += [(name, ctypes.c_double) for name in ("step", "residual", "rank_gap")]


library = ctypes.CDLL(sys.argv[1])
if library.mw_abi() != ABI:
    sys.exit(f"{sys.argv[1]} has ABI {library.mw_abi()}, this program needs ABI {ABI}")
library.mw_drive_cylindrical_worm_zn_zn.restype = ctypes.c_void_p
drive = ctypes.c_void_p(library.mw_drive_cylindrical_worm_zn_zn())
header = (Path(sys.argv[1]).parent / "include" / "cylindrical_worm_zn_zn.h").read_text(encoding="utf-8")
place = {key: int(index) for key, index in re.findall(r"#define \w+_P_(\w+) (\d+)", header)}
design = {
    "normal_module_mm": 2, "worm_threads": 1, "wheel_teeth": 277, "worm_lead_angle_deg": math.radians(3),
    "pressure_angle_deg": math.radians(10), "pitch_line_shift_mm": 4, "hob_pitch_radius_mm": 20.063824,
}  # fmt: skip
p = (ctypes.c_double * 128)(*[math.nan] * 128)
for key, value in design.items():
    p[place[key]] = value
s, work, x, info = (ctypes.c_double * 512)(), (ctypes.c_double * 128)(), (ctypes.c_double * 8)(), Info()
if library.mw_complete(drive, p, work, ctypes.byref(info)):
    sys.exit("the design cannot be completed")
status = library.mw_solve(drive, p, ctypes.c_double(7.0), s, work, x, ctypes.byref(info))
if status < 0:
    library.mw_status_text.restype = ctypes.c_char_p
    sys.exit(library.mw_status_text(status).decode())
(error,) = (int(index) for index in re.findall(r"#define \w+_U_transmission_error (\d+)", header))
print(f"status {status}, transmission error {math.degrees(x[error]) * 3600:.6f} arcsec")
