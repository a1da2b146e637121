# Shared by ./demo, ./check and .ci/run, which source it: messages, packages, configuring, building.
# shellcheck shell=bash disable=SC2034

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1
jobs=$(nproc)

# What each group is for: docs/dependencies.md (a test compares the two).
build_packages=(
  g++ cmake ninja-build pkg-config
  libeigen3-dev libfmt-dev nlohmann-json3-dev libtomlplusplus-dev libcli11-dev libmuparser-dev
  libtbb-dev liblapack-dev node-d3
)
test_packages=(libgtest-dev libbenchmark-dev python3)
browser_packages=(chromium chromium-driver fonts-dejavu-core)
format_packages=(clang-format)
tidy_packages=(clang-tidy)

say() { printf '==> %s\n' "$*"; }
fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# Ubuntu's chromium package only points to a snap, which neither containers nor tests can rely on.
browser_is_packaged() { ! grep -qx 'ID=ubuntu' /etc/os-release 2>/dev/null; }

# Those of the named packages that are not installed. dpkg-query reads a local file, so asking
# every time costs nothing.
missing_packages() {
  local installed package
  installed=" $(dpkg-query -W -f='${Package}=${db:Status-Status} ' "$@" 2>/dev/null || true) "
  for package in "$@"; do
    [[ $installed == *" $package=installed "* ]] || printf '%s\n' "$package"
  done
}

# install_packages NAME..: nothing at all happens when they are there already.
install_packages() {
  if ! { command -v dpkg-query && command -v apt-get; } >/dev/null; then
    fail "this is no Debian or Ubuntu system (no apt-get). Install the libraries that" \
      "docs/dependencies.md lists and repeat with --no-install."
  fi
  local missing as_root=() log=$root/build/packages.log
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if (($(id -u) != 0)); then
    command -v sudo >/dev/null ||
      fail "packages are missing and there is no sudo. As root, run:" \
        "apt-get install --no-install-recommends ${missing[*]}"
    say "sudo is asked for, to install packages"
    sudo -v || fail "no right to install packages"
    as_root=(sudo)
  fi
  mkdir -p build
  say "installing with apt (log: build/packages.log): ${missing[*]}"
  # Lists older than the mirror name files that are gone, hence the update; whether it sufficed
  # is for the installation to say, as a broken third-party source need not concern us.
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)
  "${apt[@]}" update >"$log" 2>&1 </dev/null || true
  if ! "${apt[@]}" install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1 </dev/null; then
    tail -n 15 "$log" >&2
    fail "apt could not install the packages; its last lines are above (all of them:" \
      "build/packages.log). Is the network reachable, and the system Debian 12 or newer?"
  fi
}

# configure PRESET [-DNAME=VALUE..]. Warnings are errors in the release build by the compiler that
# the continuous checks use: another version may warn where this one does not, which should not
# fail a stranger's build, and sanitizers make GCC warn where nothing is wrong.
configure() {
  local preset=$1 log=build/configure-$1.log werror=OFF
  shift
  [[ $preset == release && $(g++ -dumpversion 2>/dev/null) == 12 ]] && werror=ON
  mkdir -p build
  if ! cmake --preset "$preset" -DFLEXURA_WERROR=$werror "$@" >"$log" 2>&1; then
    cat "$log" >&2
    fail "cmake could not configure build/$preset"
  fi
}

# build PRESET [--target NAME]
build() {
  local preset=$1
  shift
  cmake --build --preset "$preset" --parallel "$jobs" "$@" || fail "build/$preset does not build"
}
