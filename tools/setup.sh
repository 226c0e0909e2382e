# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by the other scripts: installs what is missing, configures and builds. Everything it says goes to stderr.
#
# Environment:
#   PLUMB_SKIP_INSTALL=1            do not look for packages: everything needed is there
#   CMAKE_BUILD_PARALLEL_LEVEL=N    compile N files at a time
#   CXX=clang++                     the compiler, when a build directory is configured for the first time

plumb_root="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)"

plumb_packages=(
    g++ cmake ninja-build
    libembree-dev libopenimageio-dev libopenexr-dev libimath-dev libpng-dev libjpeg-dev
    libtinyobjloader-dev libpugixml-dev libtbb-dev libcli11-dev libfmt-dev libssl-dev zlib1g-dev catch2
)
[[ ${CXX:-} != clang++ ]] || plumb_packages+=(clang libclang-rt-dev)

say() { printf 'plumb: %s\n' "$*" >&2; }
die() { say "$@"; exit 1; }

# Prints the packages among the arguments that are not installed, on one line.
missing_packages() {
    local installed
    # dpkg-query fails when it has never heard of a package: that one is missing, too.
    installed=" $(dpkg-query --show --showformat='${db:Status-Status}:${Package} ' "$@" 2>/dev/null || true)"
    local package
    for package in "$@"; do
        [[ $installed == *" installed:$package "* ]] || printf '%s ' "$package"
    done
}

say_what_is_needed() {
    say "this system has no apt-get, so nothing can be installed for you"
    say "Plumb needs a C++20 compiler, CMake 3.22 and Ninja, and these libraries with their headers:"
    say "    Embree 3.13 or 4, OpenImageIO, OpenEXR, libpng, libjpeg-turbo, Imath 3, tinyobjloader, pugixml, oneTBB, CLI11, fmt, OpenSSL 1.1 or 3, zlib, Catch2 2 or 3"
    say "In Debian 12 and 13 they are: ${plumb_packages[*]}"
    say "When they are installed: PLUMB_SKIP_INSTALL=1 $0 ..."
}

# Runs a command with its output in a file; shows the file only if the command fails.
quietly() {
    local log status=0
    log="$(mktemp)"
    "$@" </dev/null >"$log" 2>&1 || status=$?
    ((status == 0)) || cat -- "$log" >&2
    rm -f -- "$log"
    return "$status"
}

# Installs those of the given packages that are missing; does nothing, fast, if none is.
install_packages() {
    [[ ${PLUMB_SKIP_INSTALL:-} != 1 ]] || return 0
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        say_what_is_needed
        exit 1
    fi
    local missing
    read -r -a missing <<<"$(missing_packages "$@")"
    ((${#missing[@]} > 0)) || return 0

    local as_root=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null ||
            die "these packages are missing, and installing them needs root or sudo: ${missing[*]}"
        as_root=(sudo)
    fi
    as_root+=(env DEBIAN_FRONTEND=noninteractive)
    say "installing with apt-get, including dependencies: ${missing[*]}"

    local install=("${as_root[@]}" apt-get install --yes --no-install-recommends "${missing[@]}")
    local fresh
    fresh="$(find /var/lib/apt/lists -maxdepth 1 -name '*Packages*' -mtime -7 -print -quit 2>/dev/null || true)"
    if [[ -z $fresh ]]; then
        quietly "${as_root[@]}" apt-get update || die "apt-get update failed"
        quietly "${install[@]}" || die "apt-get install failed"
    elif ! "${install[@]}" </dev/null >/dev/null 2>&1; then
        # The lists are too old for the mirror, perhaps.
        quietly "${as_root[@]}" apt-get update || die "apt-get update failed"
        quietly "${install[@]}" || die "apt-get install failed"
    fi
}

# Every file of the tree that git would keep, or, without git, every file outside the build directories; from the directory
# above tools/, each ends with a zero.
tree_files() (
    cd -- "$plumb_root" || return
    if command -v git >/dev/null && [[ $(git rev-parse --show-toplevel 2>/dev/null) -ef . ]]; then
        git ls-files --cached --others --exclude-standard -z
    else
        find . -type d \( -name .git -o -name 'build*' -o -name __pycache__ \) -prune -o -type f -print0
    fi
)

# build_directory PRESET: where CMakePresets.json builds it.
build_directory() {
    case $1 in
        release) printf '%s\n' "$plumb_root/build" ;;
        dev | lean | debug | asan | arm64 | fuzz | coverage) printf '%s\n' "$plumb_root/build-$1" ;;
        *) die "unknown preset '$1': release, dev, lean, debug, asan, arm64, fuzz or coverage" ;;
    esac
}

# build PRESET [TARGET]: configures if that was never done, the tree has moved or the presets have changed, and builds.
build() {
    local preset=$1 target=${2:-all} directory
    directory="$(build_directory "$preset")"
    mkdir -p -- "$directory"
    (
        # One build at a time in one directory. The file is open in this subshell only.
        exec 9>"$directory/.lock"
        ! command -v flock >/dev/null || flock 9
        cd -- "$plumb_root" || exit
        local cache=$directory/CMakeCache.txt
        if [[ -f $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$plumb_root" "$cache"; then
            say "$directory was configured for another directory; starting again"
            rm -rf -- "$cache" "$directory/CMakeFiles" "$directory/build.ninja"
        fi
        [[ -f $directory/build.ninja ]] ||
            say "configuring and building the '$preset' preset in $directory; this takes some minutes, once"
        # Newer than a file that is missing, too. CMake itself would not notice that the presets have changed.
        if [[ CMakePresets.json -nt $directory/build.ninja ]]; then
            quietly cmake --preset "$preset" 9>&- || die "configuring failed"
        fi
        quietly cmake --build "$directory" --target "$target" -- --quiet 9>&- || die "the build failed"
    )
}
