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

# Builds the targets given in the project of test/sanitized, with clang++ and these sanitizers: a build
# folder for each kind.
build_sanitized()  # $1: address,undefined or thread; $2 ...: targets
{
  local folder=$build_dir/sanitized/${1%%,*}
  mkdir -p -- "$folder"
  cmake -S "$source_dir/test/sanitized" -B "$folder" -G Ninja -DCMAKE_CXX_COMPILER=clang++ \
    -DSANITIZERS="$1" -DCLOTH_TEARING_MESSAGES="$build_dir/devel/include" \
    > "$folder/configure.log" 2>&1 ||
    { cat "$folder/configure.log" >&2; fail "cmake could not configure test/sanitized"; }
  cmake --build "$folder" --parallel "$(nproc)" --target "${@:2}" || fail "the build failed"
}

# -- showing things on a display of our own ------------------------------------------------------

# From here on, every process started carries a mark in its environment, and so do its children: by
# it all of them are found, and ended when the script ends.
stop_all_at_the_end()
{
  export CLOTH_TEARING_MARK=$$-$RANDOM-$SECONDS
  trap stop_all EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
}

marked_processes()
{
  grep --files-with-matches --null-data --line-regexp --fixed-strings --no-messages \
    "CLOTH_TEARING_MARK=$CLOTH_TEARING_MARK" /proc/[0-9]*/environ | cut -d / -f 3
}

wait_for_end()  # of process $1, for $2 seconds
{
  timeout "$2" tail --pid="$1" -f /dev/null 2> /dev/null || true
}

# Ends what was started, in good order first: roslaunch takes its nodes with it.
stop_all()
{
  trap - EXIT INT TERM HUP
  local pid
  for pid in "${launch_pid:-}" "${xvfb_pid:-}"; do
    if [[ -n $pid ]] && kill -TERM "$pid" 2> /dev/null; then
      wait_for_end "$pid" 30
    fi
  done
  for pid in $(marked_processes); do
    kill -KILL "$pid" 2> /dev/null || true
  done
}

start_xvfb()  # $1: WIDTHxHEIGHT
{
  # It finds a free display by itself and tells its number.
  exec {xvfb_output}< <(exec Xvfb -displayfd 1 -screen 0 "$1x24" -nolisten tcp \
    2> "$build_dir/xvfb.log")
  xvfb_pid=$!
  local number
  read -r -t 60 -u "$xvfb_output" number ||
    { cat "$build_dir/xvfb.log" >&2; fail "Xvfb did not start"; }
  export DISPLAY=:$number LIBGL_ALWAYS_SOFTWARE=1
}

# Writes what is on the display; again if there is no more on it than a window's frame yet.
take_picture()  # $1: PNG file
{
  local attempt
  for attempt in 1 2 3 4 5; do
    import -window root "png:$1" && (($(identify -format %k "$1") > 256)) &&
      return 0
    sleep 0.5
  done
  say "no picture after $attempt attempts: rviz shows nothing"
  return 1
}

# Prints what a viewer wants to know of a line of the log. A message of several lines, as that of a
# refusal to start, is printed whole: `printing` remembers that the last line belonged to one.
print_line()  # $1
{
  case $1 in
    'tear '* | 'scene: '* | 'tears: '*) printing= ;;
    *'process has died'*) printing= ;;
    *ERROR* | *FATAL*) printing=yes ;;
    *'['*INFO*']'* | *'['*WARN*']'* | *'['*DEBUG*']'* | '' | '='* | '['*) printing=; return ;;
    *) [[ -n $printing ]] || return 0 ;;
  esac
  printf '%s\n' "$1"
  [[ $1 != *$'\e[0m' ]] || printing=  # the end of a coloured message
}

# Plays a launch file to its end, writes what it says to a log and prints of it what a viewer wants
# to know; each line is handed to a function.
follow_launch()  # $1: deadline [s]; $2: log; $3: function; then the launch file and its arguments
{
  local deadline=$((SECONDS + $1)) log=$2 on_line=$3 line
  shift 3
  printing=
  : > "$log"
  exec {launch_output}< <(exec "$build_dir/devel/env.sh" roslaunch cloth_tearing "$@" 2>&1)
  launch_pid=$!
  while ((SECONDS < deadline)) &&
    read -r -t "$((deadline - SECONDS))" -u "$launch_output" line; do
    printf '%s\n' "$line" >> "$log"
    print_line "$line"
    "$on_line" "$line"
  done
  ((SECONDS < deadline)) || fail "it did not end in time; $log has what was said"
  exec {launch_output}<&-
  launch_pid=
}
