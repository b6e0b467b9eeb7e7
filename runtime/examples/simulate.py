"""A component of FMI 2 in a simulation of one's own, by FMPy: the pinion turns over a pitch while the wheel is pressed
against it. Arguments: the file that `meshwright export DESIGN --fmu FILE --fmi 2` wrote, ratio, pitch in rad.
"""

import math
import shutil
import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

STEPS, STIFFNESS, PRESSED = 20, 4e4, 1e-5

path, ratio, pitch = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
known, folder = read_model_description(path), extract(path)
number = {variable.name: variable.valueReference for variable in known.modelVariables}
unit = FMU2Slave(guid=known.guid, unzipDirectory=folder, modelIdentifier=known.coSimulation.modelIdentifier)
unit.instantiate()
unit.setupExperiment()
unit.setReal([number["stiffness"]], [STIFFNESS])
unit.enterInitializationMode()
unit.exitInitializationMode()
print("pinion rad, error arcsec, torque on the wheel N m")
error = 0.0
for k in range(STEPS + 1):
    angle = pitch * k / STEPS
    for pressed in (0.0, PRESSED):  # where the wheel would stand free of load, then a little behind
        unit.setReal([number["phi_a"], number["phi_b"]], [angle, ratio * angle + error - pressed])
        unit.doStep(currentCommunicationPoint=k / STEPS, communicationStepSize=1.0 / STEPS)
        error, torque = unit.getReal([number["transmission_error"], number["tau_b"]])
    print(f"{angle:.9f} {math.degrees(error) * 3600.0:.9f} {torque:.6f}")
unit.terminate()
unit.freeInstance()
shutil.rmtree(folder)
