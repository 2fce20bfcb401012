# Every target makes its own environment first (.venv), once.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.complete

.DEFAULT_GOAL := help
.PHONY: help demo studio derive check test lint bench bench-diagnosis docs clean faults package lock

# The lock without its hashes: constraints with hashes would ask for a hash of everything else too.
PINS := sed -n 's/^\([A-Za-z0-9._-]*==[^ ;]*\).*/\1/p' requirements.lock

help:  ## list the targets
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 18

# What builds the project (setuptools) is in the lock too: --no-build-isolation takes it from there. Byte code is made on all cores.
$(STAMP): requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or newer is needed: make PYTHON=python3.x")'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile --no-deps --require-hashes -r requirements.lock
	$(BIN)/python -m compileall -qq -j 0 -x '/tests?/' $(VENV)/lib || true
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	@touch $@

demo: $(STAMP)  ## find a hidden effect in a recorded flight, add it, watch the error fall
	rm -rf demo-output
	$(BIN)/ragg demo --output demo-output

studio: $(STAMP)  ## open the demonstration in a browser: look, tick, derive, watch the error fall
	@test -d demo-studio || $(BIN)/ragg new demo-studio > /dev/null
	$(BIN)/ragg studio demo-studio examples/demo-flight.parquet

derive: $(STAMP)  ## derive every model and generate all code anew
	$(BIN)/ragg derive

check: $(STAMP)  ## does the committed code match the derivation?
	$(BIN)/ragg derive --check

# Two workers share the cores, so neither starts threads of linear algebra; each takes whole files, whose fixtures are then made once.
test: export OPENBLAS_NUM_THREADS := 1
# Every process that the tests start would compile the program anew.
test: export PYTHONDONTWRITEBYTECODE :=
test: $(STAMP)  ## run the tests
	$(BIN)/python -m pytest -q -n 2 --dist loadfile --no-loadscope-reorder

lint: $(STAMP)  ## style, types, layers, whether the lock is complete, and the size of the project
	$(BIN)/python -m pip --disable-pip-version-check check
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	@$(BIN)/python .ci/sizes.py

# The rival of the evaluation is optional: if it cannot be installed here it is reported as missing.
RIVALS := .venv-bench/.complete
$(RIVALS): requirements.lock pyproject.toml
	$(PYTHON) -m venv .venv-bench
	.venv-bench/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	.venv-bench/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	$(PINS) > .venv-bench/pins
	@.venv-bench/bin/python -m pip install --quiet --disable-pip-version-check -c .venv-bench/pins heyoka \
	  || echo "heyoka cannot be installed here"
	@touch $@

bench: $(RIVALS)  ## measure speed, as ratios within one run (10 minutes; docs/contributors/benchmarks.md)
	.venv-bench/bin/python -m benchmarks

bench-diagnosis: export OPENBLAS_NUM_THREADS := 1
bench-diagnosis: $(STAMP)  ## measure the diagnosis on 720 flights (resumable, an hour)
	$(BIN)/python -m benchmarks.diagnosis --jobs 2 --against benchmarks/diagnosis/reference.csv

faults: $(STAMP)  ## kill commands at random moments: 100 trials
	$(BIN)/python -m tests.test_faults

package:  ## build wheel and sdist, install into an empty environment, run the demo there
	PYTHON=$(PYTHON) .ci/package

lock:  ## put the hashes of all files of each release into the lock (after adding a line NAME==VERSION)
	$(PYTHON) -m venv .venv-tools
	.venv-tools/bin/python -m pip install --quiet --disable-pip-version-check uv==0.13.9
	$(PINS) > .venv-tools/pins.in
	.venv-tools/bin/uv pip compile --quiet --no-config --no-deps --universal --python-version 3.11 --generate-hashes \
	  --no-header --no-annotate --no-emit-index-url .venv-tools/pins.in -o .venv-tools/pins.lock > /dev/null
	cp .venv-tools/pins.lock requirements.lock

docs: $(STAMP)  ## build the documentation site into docs/_build/html (offline; warnings are errors)
	$(BIN)/python -m sphinx -q -j 2 -b html -W --keep-going docs docs/_build/html
	@echo "open docs/_build/html/index.html"

clean:  ## remove the environment and caches
	rm -rf docs/_build docs/_made $(VENV) .venv-bench .venv-tools .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache build dist *.egg-info
