"""A drive as a functional mock-up unit of FMI 2.0 or 3.0: model exchange and co-simulation in one archive.

The torques follow from one energy over the pairs of both flanks (``templates/fmu.c``); a unit has no continuous state.
"""

import platform
import shlex
import subprocess
import sys
import tempfile
import uuid
import zipfile
from dataclasses import dataclass, replace
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from meshwright.base.compile import CompileError, compiler
from meshwright.base.errors import LibraryError, UsageError
from meshwright.base.files import write_bytes
from meshwright.export.packages import filled, header, numbers, prefix, said

#: Name of the binary and of the model in C.
IDENTIFIER = "mesh"

#: Platforms by the names of FMI 2 and of FMI 3, with the compiler's target and the ending of a binary.
PLATFORMS = {
    "x86_64-linux": ("linux64", "x86_64-linux-gnu.2.17", "so"),
    "x86_64-windows": ("win64", "x86_64-windows-gnu", "dll"),
    "x86_64-darwin": ("darwin64", "x86_64-macos", "dylib"),
    "aarch64-linux": (None, "aarch64-linux-gnu.2.17", "so"),
    "aarch64-darwin": (None, "aarch64-macos", "dylib"),
}

FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-fno-math-errno", "-fPIC", "-fvisibility=hidden", "-shared")

#: Units by exponents of SI and a factor.
UNITS = {
    "rad": 'rad="1"', "rad/s": 'rad="1" s="-1"', "s/rad": 's="1" rad="-1"', "N.m": 'kg="1" m="2" s="-2"',
    "N.m/rad": 'kg="1" m="2" s="-2" rad="-1"', "J": 'kg="1" m="2" s="-2"', "W": 'kg="1" m="2" s="-3"',
    "mm": 'm="1" factor="0.001"', "deg": 'rad="1" factor="0.017453292519943295"', "1": "",
}  # fmt: skip


@dataclass(frozen=True)
class Variable:
    """A variable of the unit: value reference, name, unit, causality, variability, type and what it depends on."""

    reference: int
    name: str
    unit: str | None
    causality: str
    variability: str
    words: str
    kind: str = "real"
    depends: tuple[int, ...] = ()
    start: float = 0.0


#: Inputs by their numbers: the pinion's angle alone; all four.
PHI_A = (1,)
ALL = (1, 2, 3, 4)

VARIABLES = (
    Variable(1, "phi_a", "rad", "input", "continuous", "angle of the pinion's shaft"),
    Variable(2, "w_a", "rad/s", "input", "continuous", "its speed"),
    Variable(3, "phi_b", "rad", "input", "continuous", "angle of the wheel's shaft"),
    Variable(4, "w_b", "rad/s", "input", "continuous", "its speed"),
    Variable(5, "stiffness", "N.m/rad", "parameter", "tunable", "of a tooth pair, at the wheel; 0: no torque"),
    Variable(6, "damping", "s/rad", "parameter", "tunable", "of the approach of a pair (Hunt, Crossley 1975)"),
    Variable(7, "friction", "1", "parameter", "tunable", "coefficient of friction of the flanks"),
    Variable(8, "tau_a", "N.m", "output", "continuous", "torque of the mesh on the pinion's shaft", depends=ALL),
    Variable(9, "tau_b", "N.m", "output", "continuous", "torque of the mesh on the wheel's shaft", depends=ALL),
    Variable(10, "transmission_error", "rad", "output", "continuous", "of rigid teeth, driven", depends=PHI_A),
    Variable(11, "ratio", "1", "output", "continuous", "d(wheel angle)/d(pinion angle)", depends=PHI_A),
    Variable(12, "backlash", "rad", "output", "continuous", "wheel angle between both flanks", depends=PHI_A),
    Variable(13, "potential_energy", "J", "output", "continuous", "of the pairs that are pressed", depends=(1, 3)),
    Variable(14, "loss", "W", "output", "continuous", "by damping and friction", depends=ALL),
    Variable(15, "gap_drive", "rad", "local", "continuous", "least wheel angle to contact, driven", depends=(1, 3)),
    Variable(16, "gap_coast", "rad", "local", "continuous", "least wheel angle to contact, ahead", depends=(1, 3)),
    Variable(17, "contact", None, "output", "discrete", "1 driven, -1 ahead, 0 none", "integer", (1, 3)),
    Variable(18, "leading_pair", "1", "output", "discrete", "number of the pair that leads", "count", (1, 3)),
)

#: Torques into the component, at the flanges of FMI 3.
FLANGES = (
    Variable(19, "flange_a.tau", "N.m", "output", "continuous", "torque into the mesh at the pinion", depends=ALL),
    Variable(20, "flange_b.tau", "N.m", "output", "continuous", "torque into the mesh at the wheel", depends=ALL),
)
#: Numbers of the least gaps of both sides, by which a simulator finds events.
GAPS = (15, 16)

#: Number of the first error of the assembly.
FIRST_MISALIGNMENT = 100

#: Samples of a pitch at which it is asked whether the drive jams.
SAMPLES = 64


def fmu(drive, coast, place, version, platforms=(), sources=False, allow_jam=False, stiffness=0.0):
    """Write the unit of a drive, and of the drive of its other flank or None, for FMI ``version`` 2 or 3; ``stiffness``
    that of a pair with which it starts, N m/rad at the wheel.

    ``platforms``: names as in the archive; this machine's unless given. Raises
    :class:`~meshwright.base.errors.UsageError` for a drive that jams, and for platforms that have no compiler.
    """
    backlash = drive.cycle(np.arange(SAMPLES) / SAMPLES * drive.pitch(), coast).backlash
    if np.any(backlash < 0.0) and not allow_jam:
        raise UsageError(
            f"--fmu: the drive jams: its least backlash is {np.min(backlash):.3g} rad of the wheel; give the design"
            f" more room, or --allow-jam"
        )
    known = [replace(v, start=float(stiffness)) if v.name == "stiffness" else v for v in VARIABLES]
    variables = (*known, *(FLANGES if version == 3 else ()), *_misalignments(drive))
    text = _source(drive, coast, version, stiffness)
    token = str(uuid.uuid5(uuid.NAMESPACE_URL, text + header(drive)))
    text = text.replace("@token@", token)
    files = {"modelDescription.xml": _description(drive, version, variables, token, sources)}
    if version == 3:
        files["terminalsAndIcons/terminalsAndIcons.xml"] = _TERMINALS
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / f"{prefix(drive)}.h").write_text(header(drive), encoding="utf-8")
        (Path(folder) / "fmu.c").write_text(text, encoding="utf-8")
        for name in platforms or (_native(version),):
            ending, binary = _compiled(folder, name, version, native=not platforms)
            files[f"binaries/{name}/{IDENTIFIER}.{ending}"] = binary
    if sources:
        files |= {"sources/fmu.c": text, f"sources/{prefix(drive)}.h": header(drive)}
        if version == 3:
            files["sources/buildDescription.xml"] = _BUILD
    _write(place, files)


def _misalignments(drive):
    """A fixed parameter for each key of the design's misalignment."""
    parameters = [p for p in drive.design.description["parameters"] if p["table"] == "misalignment"]
    given = drive.design.tables.get("misalignment", {})
    return [
        Variable(
            FIRST_MISALIGNMENT + k, f"misalignment.{p['key']}", p["key_unit"], "parameter", "fixed", p["meaning"],
            start=float(given.get(p["key"]) or 0.0),
        )
        for k, p in enumerate(parameters)
    ]  # fmt: skip


def _source(drive, coast, version, stiffness):
    parameters = drive.design.description["parameters"]
    places = [k for k, p in enumerate(parameters) if p["table"] == "misalignment"]
    other = drive.design if coast is None else coast.design
    starts = [variable.start for variable in _misalignments(drive)]
    return filled(
        "fmu.c",
        interface=filled(f"fmi{version}.h"),
        said=said(drive),
        fmi=version,
        drive=prefix(drive),
        sign=drive.design.mirror.sign,
        driven=numbers(drive.design.parameters),
        coasting=numbers(other.parameters),
        coast=int(coast is not None),
        misalignments=len(places),
        misaligned=", ".join(map(str, [*places, -1])),
        factors=numbers([*(parameters[k]["factor"] for k in places), 1.0]),
        starts=numbers([*starts, 0.0]),
        stiffness=repr(float(stiffness)),
    )


def _native(version):
    machine = {"amd64": "x86_64", "arm64": "aarch64"}.get(platform.machine().lower(), platform.machine().lower())
    name = f"{machine}-{platform.system().lower()}"
    if name not in PLATFORMS or (version == 2 and PLATFORMS[name][0] is None):
        raise UsageError(f"--fmi {version}: it has no name for this machine ({name}); give --platforms")
    return name if version == 3 else PLATFORMS[name][0]


def _compiled(folder, name, version, native):
    """Ending and bytes of the binary for a platform."""
    known = {(entry[0] if version == 2 else key): entry for key, entry in PLATFORMS.items()}
    known.pop(None, None)
    if name not in known:
        raise UsageError(f"--platforms {name}: FMI {version} has {', '.join(known)}; name some of these")
    _, target, ending = known[name]
    command = compiler() if native else (sys.executable, "-m", "ziglang", "cc", "-target", target)
    binary = Path(folder) / f"{IDENTIFIER}.{ending}"
    command = [*command, *FLAGS, f"-I{folder}", str(Path(folder) / "fmu.c"), "-o", str(binary)]
    command += ["-lm"] if ending == "so" else []
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except OSError as error:
        raise CompileError(f"{command[0]}: {error.strerror}") from error
    if done.returncode and "No module named ziglang" in done.stderr:
        raise UsageError(
            f"--platforms {name}: ziglang, which compiles for other machines, is not installed; "
            f"`pip install 'meshwright[live]'` brings it"
        )
    if done.returncode:
        raise LibraryError(f"the unit did not compile: {shlex.join(command)}\n{done.stderr.strip()}")
    return ending, binary.read_bytes()


def _write(place, files):
    """The archive, with the same bytes for the same files."""
    with tempfile.TemporaryDirectory() as folder:
        archive = Path(folder) / "unit.fmu"
        with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
            for name, content in files.items():
                entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
                entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
                packed.writestr(entry, content)
        write_bytes(place, archive.read_bytes())


def _description(drive, version, variables, token, sources):
    return (_fmi2 if version == 2 else _fmi3)(said(drive), variables, token, sources)


def _units(variables):
    used = dict.fromkeys(v.unit for v in variables if v.unit)
    return "".join(f'    <Unit name="{unit}"><BaseUnit {UNITS[unit]}/></Unit>\n'.replace(" />", "/>") for unit in used)


def _scalar(variable):
    """FMI 2."""
    kind = "Integer" if variable.kind == "integer" else "Real"
    inner = f' unit="{variable.unit}"' if variable.unit else ""
    if variable.causality in ("input", "parameter"):
        inner += f' start="{variable.start!r}"'
    initial = ' initial="exact"' if variable.causality == "parameter" else ""
    initial = ' initial="calculated"' if variable.causality in ("output", "local") else initial
    return (
        f'    <ScalarVariable name="{variable.name}" valueReference="{variable.reference}"'
        f' causality="{variable.causality}" variability="{variable.variability}"{initial}'
        f" description={quoteattr(variable.words)}><{kind}{inner}/></ScalarVariable>\n"
    )


def _fmi2(words, variables, token, sources):
    places = {variable.reference: k for k, variable in enumerate(variables, 1)}
    files = '<SourceFiles><File name="fmu.c"/></SourceFiles>' if sources else ""

    def unknown(variable):
        depends = " ".join(str(places[r]) for r in variable.depends)
        return f'      <Unknown index="{places[variable.reference]}" dependencies="{depends}"/>\n'

    outputs = "".join(unknown(v) for v in variables if v.causality == "output")
    initial = "".join(unknown(v) for v in variables if v.causality == "output")
    able = f'modelIdentifier="{IDENTIFIER}" canGetAndSetFMUstate="true" canSerializeFMUstate="true"'
    able += ' providesDirectionalDerivative="true"'
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<fmiModelDescription fmiVersion="2.0" modelName="{IDENTIFIER}"'
        f' guid="{token}" description={quoteattr(words)} generationTool="meshwright"'
        f' variableNamingConvention="structured" numberOfEventIndicators="2">\n'
        f'  <ModelExchange {able} completedIntegratorStepNotNeeded="true">{files}</ModelExchange>\n'
        f'  <CoSimulation {able} canHandleVariableCommunicationStepSize="true">{files}</CoSimulation>\n'
        f"  <UnitDefinitions>\n{_units(variables)}  </UnitDefinitions>\n"
        f'  <LogCategories><Category name="logStatusError"/></LogCategories>\n'
        f'  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.001"/>\n'
        f"  <ModelVariables>\n{''.join(map(_scalar, variables))}  </ModelVariables>\n"
        f"  <ModelStructure>\n    <Outputs>\n{outputs}    </Outputs>\n"
        f"    <InitialUnknowns>\n{initial}    </InitialUnknowns>\n  </ModelStructure>\n</fmiModelDescription>\n"
    )


_TYPES = {"real": "Float64", "integer": "Int32", "count": "Int64"}


def _typed(variable):
    """FMI 3."""
    kind = _TYPES[variable.kind]
    unit = f' unit="{variable.unit}"' if variable.unit and kind == "Float64" else ""
    start = f' start="{variable.start!r}"' if variable.causality in ("input", "parameter") else ""
    initial = ' initial="calculated"' if variable.causality in ("output", "local") else ""
    return (
        f'    <{kind} name="{variable.name}" valueReference="{variable.reference}" causality="{variable.causality}"'
        f' variability="{variable.variability}"{initial}{unit}{start} description={quoteattr(variable.words)}/>\n'
    )


def _fmi3(words, variables, token, sources):
    def entry(tag, variable):
        depends = " ".join(map(str, variable.depends))
        return f'    <{tag} valueReference="{variable.reference}" dependencies="{depends}"/>\n'

    outputs = "".join(entry("Output", v) for v in variables if v.causality == "output")
    initial = "".join(entry("InitialUnknown", v) for v in variables if v.causality == "output")
    gaps = "".join(f'    <EventIndicator valueReference="{reference}"/>\n' for reference in GAPS)
    able = f'modelIdentifier="{IDENTIFIER}" canGetAndSetFMUState="true" canSerializeFMUState="true"'
    able += ' providesDirectionalDerivatives="true"'
    time = '    <Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>\n'
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<fmiModelDescription fmiVersion="3.0" modelName="{IDENTIFIER}"'
        f' instantiationToken="{token}" description={quoteattr(words)} generationTool="meshwright"'
        f' variableNamingConvention="structured">\n'
        f"  <ModelExchange {able}/>\n"
        f'  <CoSimulation {able} canHandleVariableCommunicationStepSize="true"/>\n'
        f"  <UnitDefinitions>\n{_units(variables)}  </UnitDefinitions>\n"
        f'  <LogCategories><Category name="logStatusError"/></LogCategories>\n'
        f'  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.001"/>\n'
        f"  <ModelVariables>\n{time}{''.join(map(_typed, variables))}  </ModelVariables>\n"
        f"  <ModelStructure>\n{outputs}{initial}{gaps}  </ModelStructure>\n</fmiModelDescription>\n"
    )


def _terminal(name, end):
    members = {"phi": f"phi_{end}", "w": f"w_{end}", "tau": f"{name}.tau"}
    inner = "".join(
        f'      <TerminalMemberVariable variableName="{variable}" memberName="{member}"'
        f' variableKind="{"inflow" if member == "tau" else "signal"}"/>\n'
        for member, variable in members.items()
    )
    return f'    <Terminal name="{name}" matchingRule="plug">\n{inner}    </Terminal>\n'


_TERMINALS = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<fmiTerminalsAndIcons fmiVersion="3.0">\n  <Terminals>\n'
    f"{_terminal('flange_a', 'a')}{_terminal('flange_b', 'b')}  </Terminals>\n</fmiTerminalsAndIcons>\n"
)
_BUILD = (
    '<?xml version="1.0" encoding="UTF-8"?>\n<fmiBuildDescription fmiVersion="3.0">\n'
    f'  <BuildConfiguration modelIdentifier="{IDENTIFIER}">\n    <SourceFileSet language="C99">\n'
    '      <SourceFile name="fmu.c"/>\n    </SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n'
)
