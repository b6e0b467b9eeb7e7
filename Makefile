# meshwright: `make run` and `make test` do everything, from a fresh machine on.
PYTHON ?= python3
VENV   := .venv
PY     := $(VENV)/bin/python
READY  := $(VENV)/.ready

.PHONY: setup generate check test

setup: $(READY)

$(READY): pyproject.toml
	test -x $(PY) || $(PYTHON) -m venv $(VENV)
	$(PY) -m pip install --quiet --upgrade pip
	$(PY) -m pip install --quiet --editable '.[derive,plot,fe,sweep,test]'
	touch $@

# Regenerate generated/ from the drives.
generate: setup
	$(PY) -m derive

# Regenerate into a temporary folder and fail on any byte of difference.
check: setup
	folder=$$(mktemp -d) && $(PY) -m derive --output $$folder && diff -r $$folder generated && rm -r $$folder

test: setup
	$(PY) -m pytest
