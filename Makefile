# meshwright: `make run` and `make test` do everything, from a fresh machine on.
PYTHON ?= python3
VENV   := .venv
PY     := $(VENV)/bin/python
READY  := $(VENV)/.ready

.PHONY: setup test

setup: $(READY)

$(READY): pyproject.toml
	test -x $(PY) || $(PYTHON) -m venv $(VENV)
	$(PY) -m pip install --quiet --upgrade pip
	$(PY) -m pip install --quiet --editable '.[derive,plot,fe,sweep,test]'
	touch $@

test: setup
	$(PY) -m pytest
