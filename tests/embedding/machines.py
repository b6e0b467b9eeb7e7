"""Run the freestanding solver on machines that this one is not: WebAssembly and emulated ARM processors."""

import struct
from dataclasses import dataclass

import numpy as np

_PAGE = 0x1000


@dataclass(frozen=True)
class Problem:
    """Arguments of ``solve``: parameters, input angle, start values, size of the state."""

    p: np.ndarray
    phi: float
    x: np.ndarray
    state: int

    def layout(self, base):
        """Addresses of p, s and x from ``base`` on."""
        s = base + 8 * len(self.p)
        return base, s, s + 8 * self.state


def wasm(path, problem):
    """Steps and solution by the WebAssembly module."""
    from wasmtime import Instance, Module, Store

    store = Store()
    exports = Instance(store, Module(store.engine, path.read_bytes()), []).exports(store)
    memory = exports["memory"]
    p, s, x = problem.layout(memory.data_len(store))
    memory.grow(store, 2)
    memory.write(store, problem.p.tobytes(), p)
    memory.write(store, problem.x.tobytes(), x)
    steps = exports["solve"](store, p, problem.phi, s, x)
    return steps, np.frombuffer(memory.read(store, x, x + 8 * len(problem.x)))


def _load(uc, elf):
    """Map and write the segments of an ELF file; returns its entry."""
    wide = elf[4] == 2
    entry, offset = struct.unpack_from("<QQ" if wide else "<II", elf, 24)
    size, count = struct.unpack_from("<HH", elf, 54 if wide else 42)
    pages = set()
    segments = []
    for k in range(count):
        at = offset + k * size
        if wide:
            kind, _, start, address, _, length, total, _ = struct.unpack_from("<IIQQQQQQ", elf, at)
        else:
            kind, start, address, _, length, total, _, _ = struct.unpack_from("<IIIIIIII", elf, at)
        if kind == 1:
            segments.append((address, elf[start : start + length]))
            pages |= set(range(address // _PAGE, -(-(address + total) // _PAGE)))
    for page in pages:
        uc.mem_map(page * _PAGE, _PAGE)
    for address, content in segments:
        uc.mem_write(address, content)
    return entry


_MEMORY, _STACK, _RETURN = 0x30000000, 0x20000000, 0x10000000


def _prepare(uc, path, problem):
    entry = _load(uc, path.read_bytes())
    for start in (_MEMORY, _STACK, _RETURN):
        uc.mem_map(start, 0x40000)
    p, s, x = problem.layout(_MEMORY)
    uc.mem_write(p, problem.p.tobytes())
    uc.mem_write(x, problem.x.tobytes())
    return entry, p, s, x


def _bits(number):
    return struct.unpack("<Q", struct.pack("<d", number))[0]


def arm64(path, problem):
    """Steps and solution on an emulated 64-bit ARM processor."""
    from unicorn import UC_ARCH_ARM64, UC_MODE_ARM, Uc
    from unicorn.arm64_const import (
        UC_ARM64_REG_CPACR_EL1,
        UC_ARM64_REG_D0,
        UC_ARM64_REG_LR,
        UC_ARM64_REG_SP,
        UC_ARM64_REG_X0,
        UC_ARM64_REG_X1,
        UC_ARM64_REG_X2,
    )  # fmt: skip

    uc = Uc(UC_ARCH_ARM64, UC_MODE_ARM)
    entry, p, s, x = _prepare(uc, path, problem)
    uc.reg_write(UC_ARM64_REG_CPACR_EL1, 3 << 20)
    registers = {UC_ARM64_REG_X0: p, UC_ARM64_REG_X1: s, UC_ARM64_REG_X2: x, UC_ARM64_REG_D0: _bits(problem.phi)}
    for register, value in (registers | {UC_ARM64_REG_SP: _STACK + 0x3FF00, UC_ARM64_REG_LR: _RETURN}).items():
        uc.reg_write(register, value)
    uc.emu_start(entry, _RETURN)
    steps = uc.reg_read(UC_ARM64_REG_X0) & 0xFFFFFFFF
    return steps, np.frombuffer(bytes(uc.mem_read(x, 8 * len(problem.x))))


def cortex_m7(path, problem):
    """Steps and solution of Cortex-M7 code on an emulated processor with its instructions, FPv5 included."""
    from unicorn import UC_ARCH_ARM, UC_MODE_THUMB, Uc
    from unicorn.arm_const import (
        UC_ARM_REG_C1_C0_2,
        UC_ARM_REG_D0,
        UC_ARM_REG_FPEXC,
        UC_ARM_REG_LR,
        UC_ARM_REG_R0,
        UC_ARM_REG_R1,
        UC_ARM_REG_R2,
        UC_ARM_REG_SP,
        UC_CPU_ARM_MAX,
    )  # fmt: skip

    uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB)
    uc.ctl_set_cpu_model(UC_CPU_ARM_MAX)
    entry, p, s, x = _prepare(uc, path, problem)
    uc.reg_write(UC_ARM_REG_C1_C0_2, uc.reg_read(UC_ARM_REG_C1_C0_2) | 0xF << 20)
    uc.reg_write(UC_ARM_REG_FPEXC, 1 << 30)
    registers = {UC_ARM_REG_R0: p, UC_ARM_REG_R1: s, UC_ARM_REG_R2: x, UC_ARM_REG_D0: _bits(problem.phi)}
    for register, value in (registers | {UC_ARM_REG_SP: _STACK + 0x3FF00, UC_ARM_REG_LR: _RETURN | 1}).items():
        uc.reg_write(register, value)
    uc.emu_start(entry | 1, _RETURN)
    return uc.reg_read(UC_ARM_REG_R0), np.frombuffer(bytes(uc.mem_read(x, 8 * len(problem.x))))


MACHINES = {"wasm": wasm, "arm64": arm64, "cortex-m7": cortex_m7}


def wasi(path, arguments):
    """(exit status, what it wrote to its standard error) of a WebAssembly program with a system interface."""
    from wasmtime import Engine, ExitTrap, Linker, Module, Store, Trap, WasiConfig

    engine = Engine()
    linker, store, system = Linker(engine), Store(engine), WasiConfig()
    linker.define_wasi()
    system.argv = [path.name, *map(str, arguments)]
    system.stderr_file = path.with_suffix(".err")
    store.set_wasi(system)
    started = linker.instantiate(store, Module(engine, path.read_bytes())).exports(store)["_start"]
    try:
        started(store)
        status = 0
    except ExitTrap as ended:
        status = ended.code
    except Trap as trap:
        status = str(trap)
    return status, path.with_suffix(".err").read_text(errors="replace")
