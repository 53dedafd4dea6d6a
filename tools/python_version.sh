#!/usr/bin/env bash
# Ends with a message where the interpreter is missing or too old.
#
# usage: tools/python_version.sh PYTHON
set -euo pipefail

if ! "$1" -c 'import sys; sys.exit(sys.version_info < (3, 10))' 2>/dev/null; then
    echo "planformer needs Python 3.10 or later; $1 is: $("$1" --version 2>&1 || true)" >&2
    echo "Name another one: make PYTHON=python3.12 ..." >&2
    exit 1
fi
