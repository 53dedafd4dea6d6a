#!/usr/bin/env bash
# Installs the system packages that planformer is built with, where they are missing.
# Debian and Ubuntu; elsewhere it says what is needed and leaves the rest to the build.
#
# usage: tools/system_packages.sh PYTHON
set -euo pipefail

python=$1
packages=(
    g++
    libboost-filesystem-dev
    libboost-program-options-dev
    libboost-serialization-dev # OMPL's CMake file asks for Boost, its package only for the headers
    libboost-system-dev
    libeigen3-dev
    libompl-dev
)

# Whether the interpreter can make a virtual environment and compile against itself.
python_is_complete() {
    "$python" - <<'PY' 2>/dev/null
import ensurepip, pathlib, sysconfig
raise SystemExit(not pathlib.Path(sysconfig.get_path("include"), "Python.h").is_file())
PY
}

missing_packages() {
    local package
    for package in "${packages[@]}"; do
        if [[ $(dpkg-query --show --showformat '${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
            echo "$package"
        fi
    done
}

explain_other_systems() {
    cat >&2 <<'TEXT'
This is not a Debian or Ubuntu system, so nothing is installed for you. planformer is built with:
  - a C++17 compiler and make
  - Python 3.10 or later with venv and its C headers
  - OMPL 1.5 or later with its C++ headers and CMake files
  - Eigen 3
  - Boost: filesystem, program_options, serialization, system
TEXT
}

install() {
    local as_root=()
    if ((EUID != 0)); then
        if ! command -v sudo >/dev/null; then
            echo "These system packages are missing and there is no sudo; install them as root:" >&2
            echo "  apt-get install $*" >&2
            exit 1
        fi
        as_root=(sudo)
    fi
    echo "Installing system packages: $*"
    "${as_root[@]}" apt-get update >/dev/null
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install --yes --no-install-recommends "$@" </dev/null >/dev/null
}

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    explain_other_systems
    exit 0
fi
python_is_complete || packages+=(python3 python3-dev python3-venv)
mapfile -t missing < <(missing_packages)
if ((${#missing[@]} > 0)); then
    install "${missing[@]}"
fi
