#!/bin/bash
# SPDX-License-Identifier: MIT
# Serves the page that build.sh has built, on this machine only:
#
#   examples/testbed/serve.sh [port] [folder]      then open http://localhost:8000
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
port=${1:-8000} page=${2:-$top/build/testbed/page}
[[ $port =~ ^[0-9]{1,5}$ && $port -ge 1 && $port -le 65535 ]] || { echo "examples/testbed/serve.sh: port = $port must lie in [1, 65535]" >&2; exit 2; }
[ -e "$page/testbed.wasm" ] || { echo "Build it first: examples/testbed/build.sh" >&2; exit 1; }
python3 -c "import http.server; http.server.HTTPServer(('127.0.0.1', $port), None)" 2>/dev/null ||
  { echo "examples/testbed/serve.sh: port $port cannot be used, another program may have it: give another one" >&2; exit 1; }
echo "http://localhost:$port (stop with Ctrl-C)"
exec python3 -m http.server --bind 127.0.0.1 --directory "$page" "$port"
