#!/usr/bin/env bash
# Prints the path of Chromium, which it installs on Debian where there is none.
#
# usage: tools/browser.sh
set -euo pipefail

find_browser() {
    command -v chromium || command -v chromium-browser || command -v google-chrome
}

if ! find_browser; then
    if ! command -v apt-get >/dev/null; then
        echo "The browser tests need Chromium; install it, or name it: CHROMIUM=/path/to/chromium" >&2
        exit 1
    fi
    if ((EUID != 0)); then as_root=(sudo); else as_root=(); fi
    echo "Installing Chromium" >&2
    "${as_root[@]}" apt-get update >/dev/null
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install --yes --no-install-recommends chromium fonts-dejavu-core </dev/null >/dev/null
    find_browser
fi
