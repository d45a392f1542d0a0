# What the scripts share: which packages are missing, which python, where and how to build.
# To be sourced by bash, not run.
# shellcheck shell=bash

set -euo pipefail

source_dir=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
build_dir=$source_dir/build

say()
{
  printf '== %s\n' "$*"
}

fail()
{
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# The packages in the named sections of scripts/apt_packages, one a line.
listed_packages()
{
  awk -v wanted=" $* " '
    /^\[/ { gsub(/[][]/, ""); inside = index(wanted, " " $0 " "); next }
    inside && NF && !/^#/ { print $1 }' "$source_dir/scripts/apt_packages" | LC_ALL=C sort
}

# Those of them that are not installed, one a line.
missing_packages()
{
  local listed
  mapfile -t listed < <(listed_packages "$@")
  # dpkg-query complains about each name that it never heard of; those are missing all the same.
  LC_ALL=C comm -23 <(printf '%s\n' "${listed[@]}") \
    <({ dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "${listed[@]}" \
      2> /dev/null || true; } | sed -n 's/^installed //p' | LC_ALL=C sort -u)
}

# Sets as_root to what has to stand before a command that needs root; false if there is no way.
find_way_to_root()
{
  as_root=()
  ((EUID != 0)) || return 0
  as_root=(sudo)
  command -v sudo > /dev/null || return 1
  sudo -n true 2> /dev/null && return 0
  [[ -t 0 ]] && sudo -v
}

# Installs what is missing of the named sections. Nothing missing: touches nothing, needs no root.
install_packages()
{
  if ! { command -v dpkg-query && command -v apt-get; } > /dev/null; then
    fail "sets up Debian bookworm; elsewhere, build in a catkin workspace as README.md shows"
  fi

  local missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]} > 0)) || return 0

  local install=(apt-get install -q -y --no-install-recommends)
  say "${#missing[@]} of the Debian packages in scripts/apt_packages are missing: ${missing[*]}"
  if ! find_way_to_root; then
    fail "installing them needs root. Run this as root, then start again:

    apt-get update && ${install[*]} ${missing[*]}
"
  fi

  local patience=(-o DPkg::Lock::Timeout=300)
  "${as_root[@]}" apt-get "${patience[@]}" -q update < /dev/null ||
    say "apt-get update failed; going on with the package lists that are there"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    "${install[@]}" "${patience[@]}" "${missing[@]}" < /dev/null ||
    fail "apt-get could not install them (the names are those of Debian bookworm)"
}

# The system's tools first: a pyenv or conda python does not know catkin, nor may modules in the
# user's home or a sourced workspace stand in for those the system's packages bring.
use_system_tools()
{
  export PATH=/usr/sbin:/usr/bin:/sbin:/bin:$PATH PYTHONNOUSERSITE=1
  unset PYTHONHOME PYTHONPATH CMAKE_PREFIX_PATH ROS_PACKAGE_PATH
}

# A master of our own on a free port: one that is already running is neither used nor disturbed.
use_private_ros()
{
  local port
  # Not of those that the system gives to outgoing connections: one of them could take it first.
  port=$(python3 -c 'import random, socket
for port in random.sample(range(12000, 32000), 1000):
    try:
        socket.socket().bind(("127.0.0.1", port))
    except OSError:
        continue
    print(port)
    break')
  unset ROS_IP ROS_NAMESPACE
  export ROS_HOSTNAME=127.0.0.1 ROS_MASTER_URI=http://127.0.0.1:$port
  export ROS_HOME=$build_dir/ros_home ROS_LOG_DIR=$build_dir/ros_home/log
}

# Is there a build folder of this source folder, made by the system's python?
is_configured()
{
  local cache=$build_dir/CMakeCache.txt
  [[ -f $cache && -f $build_dir/build.ninja ]] &&
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$source_dir" "$cache" &&
    grep -qxE 'PYTHON_EXECUTABLE:[A-Z]+=/usr/bin/python3' "$cache"
}

# Configures the build folder with the options given; one made for others is wiped, because cmake
# keeps the python and the paths that it found first.
configure()
{
  if [[ -e $build_dir ]] && ! is_configured; then
    say "wiping $build_dir, which was made by another python, for another folder or not finished"
    rm -rf -- "$build_dir"
  fi
  mkdir -p -- "$build_dir"
  local log=$build_dir/configure.log
  cmake -S "$source_dir" -B "$build_dir" -G Ninja --no-warn-unused-cli \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 \
    "$@" > "$log" 2>&1 || { cat "$log" >&2; fail "cmake could not configure the package"; }
}

# Builds the targets given.
build()
{
  cmake --build "$build_dir" --parallel "$(nproc)" --target "$@" || fail "the build failed"
}
