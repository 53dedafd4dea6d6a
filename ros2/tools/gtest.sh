#!/usr/bin/env bash
# Installs GoogleTest, which the Nav2 plugin's tests need, where it is missing. Debian and Ubuntu;
# elsewhere CMake says what it misses.
set -euo pipefail

if ! command -v apt-get >/dev/null; then exit 0; fi
state=$(dpkg-query --show --showformat '${db:Status-Status}' libgtest-dev 2>/dev/null || true)
if [[ $state == installed ]]; then exit 0; fi
as_root=()
if ((EUID != 0)); then as_root=(sudo); fi
echo "Installing system packages: libgtest-dev"
"${as_root[@]}" apt-get update >/dev/null
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends libgtest-dev </dev/null >/dev/null
