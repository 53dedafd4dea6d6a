# `make demo` and `make test` set up all they need; `make help` lists the rest.

# Overridable, for example: make PYTHON=python3.12 PIP_ARGS="--index-url ..." test
PYTHON ?= python3
VENV ?= .venv
PIP_ARGS ?=
PYTEST_ARGS ?= -n 2

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
MAKEFLAGS += --no-builtin-rules
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help

BIN := $(abspath $(VENV))/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
CPP := $(shell find cpp -name '*.cpp' -o -name '*.hpp')
NAV2 := $(shell find ros2/planformer_nav2 -name '*.cpp' -o -name '*.hpp')
PACKAGES := $(shell find src -name '__init__.py')

# Stamps: files that stand for a step of the set-up that is done.
VENV_READY := $(VENV)/.stamp-venv
PACKAGE_READY := $(VENV)/.stamp-package
DEV_READY := $(VENV)/.stamp-dev
include web/web.mk

## demo: plan with MPT-RRT* on a generated floor plan and draw it to demo/
.PHONY: demo
demo: $(PACKAGE_READY)
	mkdir -p demo
	$(BIN)/planformer map indoor --seed 6 --output demo/office.yaml
	$(BIN)/planformer plan demo/office.yaml --start 19.1 3.4 --goal 2 22.4 \
	    --planner RRTstar --guide mpt --max-vertices 2500 --seed 1 --output demo

## test: run the test suite
.PHONY: test
test: $(DEV_READY) $(PACKAGE_READY)
	$(BIN)/pytest $(PYTEST_ARGS)

## test-core: fuzz the car's curves with 10 million pairs of poses, check its neighbours
.PHONY: test-core
test-core: $(DEV_READY)
	PATH="$(BIN):$$PATH" cmake -S . -B build/core -G Ninja --log-level=WARNING \
	    -DPLANFORMER_PYTHON=OFF -DPLANFORMER_CPP_TESTS=ON
	$(BIN)/cmake --build build/core
	$(BIN)/ctest --test-dir build/core --parallel "$$(nproc)" --output-on-failure

## test-ros: test the ROS 2 node on ROS from PyPI, in an environment of its own, and the Nav2 plugin
.PHONY: test-ros
test-ros:
	@$(MAKE) --file ros2/test.mk

## playground: open the playground in a browser (PORT=8000)
PORT ?= 8000
.PHONY: playground
playground: $(SERVE_READY) $(PACKAGE_READY)
	$(BIN)/planformer serve --port $(PORT) --open

## web: build the page of the playground, after a change in web/
.PHONY: web
web: $(PAGE_READY)
	$(NPM) run build

## test-web: check the page and test it in a browser; TEST_ARGS="-g drag" runs some of it
TEST_ARGS ?=
.PHONY: test-web
test-web: $(PAGE_READY) $(SERVE_READY) $(PACKAGE_READY)
	$(NPM) run check
	$(NPM) test
	PAGE_OUT=$(abspath build/page) $(NPM) run build
	diff --recursive build/page $(PAGE) # a page that differs was not built: run `make web`
	CHROMIUM="$${CHROMIUM:-$$(tools/browser.sh)}" PYTHON=$(BIN)/python \
	    $(NPM) run test:browser -- $(TEST_ARGS)

## lint: check style, types and layers
.PHONY: lint
lint: $(DEV_READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/clang-format --dry-run --Werror $(CPP) $(NAV2)
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo

## format: bring Python and C++ code into style
.PHONY: format
format: $(DEV_READY)
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(BIN)/clang-format -i $(CPP) $(NAV2)

## wheel: build a wheel that carries OMPL into dist/ and try it in an environment of its own
.PHONY: wheel
wheel: $(DEV_READY)
	rm -rf build/wheel dist
	$(PIP) wheel $(PIP_ARGS) --no-deps --config-settings build-dir=build/wheel/cmake \
	    --wheel-dir build/wheel .
	PATH="$(BIN):$$PATH" auditwheel repair --wheel-dir dist build/wheel/*.whl
	$(PYTHON) -m venv --clear build/wheel/venv
	build/wheel/venv/bin/pip --disable-pip-version-check --quiet install $(PIP_ARGS) dist/*.whl
	build/wheel/venv/bin/python tools/check_wheel.py

## clean: remove what was built, but not the environment
.PHONY: clean
clean:
	rm -rf build demo dist .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache

## distclean: remove the environments as well
.PHONY: distclean
distclean: clean
	rm -rf $(VENV) $(ROS_VENV)

## help: list the targets
.PHONY: help
help:
	@sed -n 's/^## /  make /p' Makefile

$(VENV_READY): tools/system_packages.sh tools/python_version.sh tools/build-requirements.txt
	@tools/system_packages.sh $(PYTHON)
	@tools/python_version.sh $(PYTHON)
	@echo "Making the environment $(VENV)"
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(PIP) install $(PIP_ARGS) --requirement tools/build-requirements.txt
	@touch $@

# Editable: Python edits are live but for a module that becomes a package; C++ edits are compiled.
$(PACKAGE_READY): $(VENV_READY) pyproject.toml CMakeLists.txt $(CPP) $(PACKAGES)
	@echo "Building planformer into $(VENV)"
	@PATH="$(BIN):$$PATH" $(PIP) install $(PIP_ARGS) --no-build-isolation --editable .
	@touch $@

# The package is installed, so pip adds only what its extras ask for.
$(DEV_READY): pyproject.toml tools/constraints.txt | $(PACKAGE_READY)
	@echo "Installing the development tools into $(VENV)"
	@$(PIP) install $(PIP_ARGS) --constraint tools/constraints.txt 'planformer[dev,train]'
	@touch $@
