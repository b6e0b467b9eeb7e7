# meshwright: `make run` and `make test` do everything, from a fresh machine on.
PYTHON ?= python3
VENV   := .venv
PY     := $(VENV)/bin/python
READY  := $(VENV)/.ready
LINT   := $(VENV)/.lint
LEAN   := $(VENV)/.lean

SHIP    := runtime/meshwright/_generated
OBJECTS := $(VENV)/objects
PUBLISHED := recess-action-full
compiled = $1 runtime/meshwright/base/compile.py generated $(SHIP) $$($1 -m derive.packaged) --objects $(OBJECTS)
shown = $(compiled) --now $$($1 -m derive.packaged $(PUBLISHED))
DERIVED = $(PY) -m derive.products
CHECKERS := check_description check check_code check_bounded check_shipped check_print

.PHONY: help setup generate audit kernel coq bench build check examples run lint test solver cmake cad fmi test-fe validate site wheels dist
.PHONY: wheels-run machines nvrtc jax precompiled preshown fuzz benchmark coverage compilers sanitizers emulators

# Compiled modules are kept, whatever the environment says: each of many short processes would compile them anew.
export PYTHONDONTWRITEBYTECODE :=

# What can be made.
help:
	@awk '/^# /{said = said " " substr($$0, 3)} /^[a-z][a-z-]*:/{if (said) print substr($$1, 1, length($$1) - 1) ":" said} \
		!/^#/{said = ""}' Makefile

setup: $(READY)

$(READY): pyproject.toml
	test -x $(PY) || $(PYTHON) -m venv $(VENV)
	$(PY) -m pip install --quiet --no-compile --editable '.[derive,plot,fe,sweep,test]'
	touch $@ $(LEAN)

# What deriving, compiling and solving need, a third of all. Modules are compiled when they are first imported.
$(LEAN): pyproject.toml
	test -x $(PY) || $(PYTHON) -m venv $(VENV)
	test $(READY) -nt pyproject.toml || $(PY) -m pip install --quiet --no-compile --editable '.[derive]'
	touch $@

# The finite-element solver, where it can be had without asking; its tests say so if it is missing.
solver:
	@command -v ccx >/dev/null || { test "$$(id -u)" = 0 && command -v apt-get >/dev/null \
		&& apt-get update -qq && apt-get install -y -qq calculix-ccx; } >/dev/null 2>&1 \
		|| echo "ccx not found and not installable here: the finite-element tests are not run"

# CMake, from its Python package where the system has none.
cmake: setup
	@command -v cmake >/dev/null || test -x $(VENV)/bin/cmake || $(PY) -m pip install --quiet cmake

# Open CASCADE, which checks every solid that is written; without it those tests are not run.
cad: setup
	@$(PY) -c "import OCP" 2>/dev/null || $(PY) -m pip install --quiet --no-compile --editable '.[cad]'

# FMPy, which checks components and runs them; without it those tests are not run.
fmi: setup
	@$(PY) -c "import fmpy" 2>/dev/null || $(PY) -m pip install --quiet --no-compile --editable '.[fmi]'

# Regenerate generated/: the drives that packaged designs use; with DRIVES="name …" those, with DRIVES=all all.
generate: $(LEAN)
	$(PY) -m derive $(DRIVES)

# Prove everything anew, write generated/audit/index.html and re-check record, code and descriptions with checkers of
# their own.
audit: setup generate
	$(MAKE) --no-print-directory --jobs 2 $(CHECKERS:%=audit-%)

audit-%:
	$(PY) generated/audit/$*.py

# Every proof of the record as a theorem that Coq's kernel accepts.
kernel: setup generate coq
	$(PY) -m derive.audit kernel

# Coq with its library of real derivatives, where it can be had without asking; what needs it says so without it.
coq:
	@command -v coqc >/dev/null || { test "$$(id -u)" = 0 && command -v apt-get >/dev/null \
		&& apt-get update -qq && apt-get install -y -qq coq libcoq-coquelicot; } >/dev/null 2>&1 \
		|| echo "coqc not found and not installable here: the proofs are not put to Coq's kernel"

# What of generated/ is not in git, where it is missing; of that the core library and the objects of the drives that
# packaged designs use, beside what the Python package ships of them; with DRIVES="name …" or DRIVES=all also those. What
# is not built is compiled when it is first used.
build: $(LEAN)
	@$(DERIVED) missing || $(MAKE) --no-print-directory --jobs 2 DRIVES= generate precompiled
	@$(call compiled,$(PY))
	@test -z "$(DRIVES)" || $(PY) -m derive $(DRIVES) --into $(SHIP)

# What can be compiled of what is committed, by the system's Python, while packages are being installed and the rest is
# derived; and of the published drive alone.
precompiled:
	@$(call compiled,$(PYTHON)) --ahead

preshown:
	@$(call shown,$(PYTHON)) --ahead

# Regenerate into a temporary folder and fail on any byte of difference from the manifest and from what git keeps; what it
# does not keep is taken from there.
check: setup
	folder=$$(mktemp -d) && $(PY) -m derive --strict --output $$folder && $(DERIVED) check $$folder && rm -r $$folder

# Set up, regenerate, prove, compile, and solve a published drive beside the paper's table. What is committed of it is
# compiled meanwhile, and again only if regenerating has changed it; other drives are compiled when they are first used.
run:
	$(MAKE) --no-print-directory --jobs 2 generate preshown
	@$(call shown,$(PY))
	$(PY) tests/published.py

# Style, names, docstrings and types, each with tools of the package registry alone.
lint: $(LINT)
	$(PY) -m ruff check derive runtime tests
	$(PY) -m basedpyright --level error

$(LINT): $(READY)
	$(PY) -m pip install --quiet --editable '.[lint]'
	touch $@

# Set up, derive and compare with what is committed, build of that, and run the tests but for the longer ones.
test:
	$(MAKE) --no-print-directory --jobs 3 check precompiled solver
	$(MAKE) --no-print-directory build cmake
	$(PY) -m pytest -m 'not slow and not validate' --numprocesses auto

# Certified contacts that other programs can be tested against: generated/benchmark, which is committed.
benchmark: setup build
	$(VENV)/bin/meshwright benchmark generated/benchmark

# The longer tests: many random designs and inputs, every drive, brute force, all theorems; some minutes of a processor for
# each file, with SIZE=full all that there is. The site is built too, in which no link or reference may be broken.
validate: setup build solver cmake cad fmi sanitizers emulators nvrtc jax coq site
	MESHWRIGHT_SIZE=$(SIZE) $(PY) -m pytest -m validate --numprocesses auto

# NVIDIA's compiler at run time from its Python package, where it can be had: it compiles for a GPU without one. Tests say so
# if it is missing.
nvrtc: setup
	@$(PY) -c "import nvidia.cuda_nvrtc" 2>/dev/null || $(PY) -m pip install --quiet nvidia-cuda-nvrtc-cu12 2>/dev/null \
		|| echo "NVRTC is not installable here: headers are not compiled for a GPU"

# JAX, where it can be had; without it those tests are not run.
jax: setup
	@$(PY) -c "import jax" 2>/dev/null || $(PY) -m pip install --quiet --no-compile --editable '.[jax]' || true

# An emulator of ARM64, where it can be had without asking.
emulators:
	@command -v qemu-aarch64-static >/dev/null || { test "$$(id -u)" = 0 && command -v apt-get >/dev/null \
		&& apt-get update -qq && apt-get install -y -qq --no-install-recommends qemu-user-static; } >/dev/null 2>&1 || true

# clang with its sanitizers, where it can be had without asking; `make fuzz` says what is not run without it.
sanitizers:
	@ls /usr/bin/clang* >/dev/null 2>&1 || { test "$$(id -u)" = 0 && command -v apt-get >/dev/null \
		&& apt-get update -qq && apt-get install -y -qq --no-install-recommends clang-14 libclang-rt-14-dev; } \
		>/dev/null 2>&1 || true

# Mutated designs, surface and report of them, the C interface under sanitizers and in threads, changed records: seeded
# and bounded, some minutes of a processor; with SIZE=full hours of it. BUDGETS="--designs 200000 --analyse 10000 --calls 10000000" are such of one's own.
# Fails at the first traceback, hang, sanitizer's report or false contact.
fuzz: setup build sanitizers
	$(PY) -m tests.fuzz --size $(or $(SIZE),short) --seed $(or $(SEED),0) $(BUDGETS)

# Lines and branches that tests reach, of runtime/c and of the Python runtime, beside what is required of each.
coverage: setup build
	$(PY) -m tests.coverage

# The bits of all results from every compiler, level of optimisation, instruction set and machine that can be had here, a
# line for each.
compilers: setup build sanitizers emulators
	MESHWRIGHT_SIZE=full $(PY) -m pytest -vv -rs --numprocesses auto tests/embedding/test_compilers.py
	MESHWRIGHT_SIZE=full $(PY) -m pytest -vv -rs --numprocesses auto tests/embedding/test_headers.py -k same_bits

# The longer finite-element validation.
test-fe: setup build solver
	$(PY) -m pytest tests/fe -m slow

# Points a second of every kernel and of the baselines, and what a user waits for, in tables.
bench: setup build
	$(PY) -m tests.benchmarks.bench

# The site: tutorial, reference, live pages, audit record; one static folder, generated/site, that is not committed.
site: setup build
	$(PY) -m pip install --quiet --editable '.[site,live]'
	$(PY) runtime/site/build.py

# One archive of what of generated/ is not in git, dist/generated.tar.gz, which generated/manifest.json pins.
dist: setup build
	$(DERIVED) pack dist/generated.tar.gz

# Wheels for Linux, macOS and Windows in dist/, all cross-compiled here; with TARGETS="linux-aarch64 …" those.
wheels: setup build
	$(PY) runtime/wheels.py dist $(TARGETS:%=--target %)

# What runs wheels of other machines, where it can be had without asking: Wine, musl, the C library of ARM64, an emulator.
machines: emulators
	@command -v wine >/dev/null && test -e /lib/ld-musl-$$(uname -m).so.1 || { test "$$(id -u)" = 0 \
		&& command -v apt-get >/dev/null && apt-get update -qq \
		&& apt-get install -y -qq --no-install-recommends wine wine64 musl; } >/dev/null 2>&1 || true

# Read the symbols of the wheels in dist/ and run what there is a machine for; says what was not run.
wheels-run: setup build machines
	$(PY) -m pip install --quiet lief
	$(PY) -m pytest -v -rs -m slow tests/embedding/test_wheels.py

# Build and run the examples: C, C++, ctypes, CMake, pkg-config, wheel, CasADi, WebAssembly, Cortex-M7, ARM64.
examples: setup build cmake
	$(PY) -m pytest tests/embedding
