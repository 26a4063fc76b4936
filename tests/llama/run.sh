#!/usr/bin/env bash
# Asks a real chat server, llama-cpp-python's, with a tiny model of random weights. Needs Python
# 3, a C++ compiler and the network; building the server takes some minutes the first time.
# Usage: tests/llama/run.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
venv=target/venv-llama
[ -d "$venv" ] || python3 -m venv "$venv"
# Speed of the server does not matter here, speed of the build does.
export CMAKE_ARGS="${CMAKE_ARGS:--DLLAVA_BUILD=OFF -DGGML_OPENMP=OFF -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DCMAKE_C_FLAGS_RELEASE=-O1}"
"$venv/bin/pip" install --quiet --disable-pip-version-check -r tests/llama/requirements.txt
"$venv/bin/python" tests/llama/make_model.py target/noise.gguf
port="$("$venv/bin/python" -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')"
"$venv/bin/python" -m llama_cpp.server --model target/noise.gguf --model_alias noise \
  --chat_format chatml --n_ctx 16384 --host 127.0.0.1 --port "$port" >target/llama-server.log 2>&1 &
server=$!
trap 'kill "$server" 2>/dev/null || true' EXIT
curl --silent --show-error --retry 60 --retry-delay 1 --retry-connrefused --output /dev/null \
  "http://127.0.0.1:$port/v1/models"
SCENEFOLD_LLAMA_SERVER="http://127.0.0.1:$port/v1" cargo test --locked --test it language::llama -- --nocapture
