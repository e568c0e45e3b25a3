# SPDX-License-Identifier: BSD-3-Clause
# Sourced by ./run and ./test: where the build is, how to find its modules, a display to draw on.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build=${VTKRADIOMETRY_BUILD_DIR:-$root/build}
python=/usr/bin/python3 # the Python that Debian's VTK and ParaView are built for

# Makes the Python package and the plugin findable (paths written by CMake).
use_build()
{
  . "$build/environment.sh"
  export PYTHONPATH="$VTKRADIOMETRY_PYTHONPATH${PYTHONPATH:+:$PYTHONPATH}"
  export PV_PLUGIN_PATH="$VTKRADIOMETRY_PLUGIN_PATH${PV_PLUGIN_PATH:+:$PV_PLUGIN_PATH}"
  # Open MPI: more ranks than cores, and root, are the user's own choice here.
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
}

# Starts one private X server that ends when this process (or what it becomes by exec) ends.
start_display()
{
  local ready
  if ! command -v Xvfb >/dev/null; then
    echo "vtkRadiometry: no display and no Xvfb to make one" >&2
    return 1
  fi
  ready=$(mktemp -u)
  mkfifo -m 600 "$ready"
  # Own session: Ctrl-C must not take the display away before the program has stopped.
  setsid setpriv --pdeathsig TERM Xvfb -displayfd 5 -noreset -nolisten tcp \
    -screen 0 1600x1200x24 5>"$ready" >/dev/null 2>&1 </dev/null &
  display_pid=$!
  local number=
  read -r -t 30 number <"$ready" || true
  rm -f "$ready"
  if [[ -z $number ]]; then
    echo "vtkRadiometry: Xvfb did not start" >&2
    return 1
  fi
  export DISPLAY=":$number"
  unset XAUTHORITY
}
