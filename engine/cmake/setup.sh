# Sourced by tests/run and samples/run from the repository root: installs what is missing and builds.
# Quiet while things go well; the log of a step that fails is shown.

export LC_ALL=C.UTF-8
build=build/release

say() { printf '%s\n' "$*" >&2; }

# quietly NAME COMMAND...: runs the command with its output in build/NAME.log, shown only when it fails.
quietly() {
    local log=build/$1.log
    shift
    mkdir -p build
    if ! "$@" >"$log" 2>&1 </dev/null; then
        tail -n 60 "$log" >&2
        say "failed: $* (the whole output: $log)"
        return 1
    fi
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# install_packages PACKAGE...: those that are missing, with apt-get; root or sudo is needed only then.
install_packages() {
    local package missing=()
    if ! command -v apt-get >/dev/null; then
        say "not Debian: install what corresponds to engine/cmake/debian-packages.txt yourself"
        return 0
    fi
    for package in "$@"; do
        installed "$package" || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
        say "missing packages, and neither root nor sudo to install them: ${missing[*]}"
        return 1
    fi
    say "installing ${#missing[@]} packages with apt-get: ${missing[*]}"
    quietly apt-update as_root apt-get update -q
    quietly apt-install as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends "${missing[@]}"
}

listed_packages() { sed 's/#.*//' engine/cmake/debian-packages.txt; }

# One compiler for each processor, but not more than memory carries: a file with toml++ or tinygltf takes 1.5 GB.
build_jobs() {
    local by_memory
    by_memory=$(awk '/^MemAvailable/ { print int($2 / 1500000) }' /proc/meminfo)
    local jobs
    jobs=$(nproc)
    [ "${by_memory:-$jobs}" -lt "$jobs" ] && jobs=$by_memory
    [ "$jobs" -lt 1 ] && jobs=1
    printf '%s\n' "$jobs"
}

# build_release [TARGET...]: installs what is missing, configures and builds the release preset.
build_release() {
    # shellcheck disable=SC2046
    install_packages $(listed_packages)
    quietly configure cmake --preset release
    say "building in $build"
    local targets=()
    [ $# -gt 0 ] && targets=(--target "$@")
    quietly build cmake --build --preset release -j "$(build_jobs)" "${targets[@]}"
}
