# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# shellcheck disable=SC2154
# Sourced after setup.sh by the scripts that need a bare Debian in a directory. They set
#   release      a release of Debian, such as trixie
#   directory    where the system is
#   tree         in it, the directory of the copy of the tree

cannot() { say "cannot be done in Debian $release: $*"; exit 77; }

# Where this system's apt gets Debian from. Not from the archive of security updates, which has only those.
debian_mirror() {
    apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
        sed -n 's/^Debian Debian //p' | sort -u | head -n 1
}

# Ends the script if there can be no such system here. Sets mirror.
need_bare_system() {
    ((EUID == 0)) || cannot "it needs root"
    command -v debootstrap >/dev/null || cannot "debootstrap is not installed"
    unshare --mount true 2>/dev/null || cannot "this system allows no mounts (a container?)"
    [[ -e /usr/share/debootstrap/scripts/$release ]] || cannot "debootstrap does not know this release"
    mirror="$(debian_mirror)"
    [[ -n $mirror ]] || cannot "apt knows no mirror of Debian (is apt-get update needed?)"
}

# The mirror may be behind a proxy, or want a password or a certificate: what is set here goes along.
copy_apt_settings() {
    local settings file
    settings="$(apt-config dump | grep -E '^Acquire::(https?|ftp|Retries)' || true)"
    printf '%s\n' "$settings" >"$directory/etc/apt/apt.conf.d/00host"
    while IFS= read -r file; do
        [[ ! -f $file ]] || install -D --preserve-timestamps -- "$file" "$directory$file"
    done < <(
        sed -n 's/^[^"]*"\(\/[^"]*\)";$/\1/p' <<<"$settings"
        printf '%s\n' /etc/apt/auth.conf /etc/apt/auth.conf.d/* /etc/ssl/certs/ca-certificates.crt
    )
}

bare_system() {
    [[ ! -e $directory/etc/plumb-complete ]] || return 0
    local http_proxy=${http_proxy:-} https_proxy=${https_proxy:-}
    eval "$(apt-config shell http_proxy Acquire::http::Proxy https_proxy Acquire::https::Proxy)"
    http_proxy=$http_proxy https_proxy=$https_proxy \
        quietly debootstrap --variant=minbase "$release" "$directory" "$mirror" || return 1
    copy_apt_settings
    # Nobody will switch this system off: nothing need be flushed to the disk.
    echo force-unsafe-io >"$directory/etc/dpkg/dpkg.cfg.d/unsafe-io"
    touch -- "$directory/etc/plumb-complete"
}

# Without git, as from an archive; build directories of an earlier time stay.
copy_tree() {
    mkdir -p -- "$directory$tree"
    find "$directory$tree" -mindepth 1 -maxdepth 1 ! -name 'build*' -exec rm -rf -- {} +
    local file
    tree_files | while IFS= read -r -d '' file; do
        [[ ! -e $plumb_root/$file ]] || printf '%s\0' "$file"
    done | tar --directory "$plumb_root" --null --files-from=- --create | tar --directory "$directory$tree" --extract
}

# Runs a command there, in the tree. Its mounts and its processes end with it, whatever happens. A directory of ccache is there,
# too, and knows files by their paths in the tree.
inside() {
    unshare --mount --pid --fork --kill-child --propagation private bash -euc '
        directory=$1 tree=$2 cache=$3
        shift 3
        mount -t proc proc "$directory/proc"
        mount --rbind /dev "$directory/dev"
        if [[ -n $cache ]]; then
            mkdir -p "$cache" "$directory/var/cache/ccache"
            mount --bind "$cache" "$directory/var/cache/ccache"
        fi
        exec chroot "$directory" env --chdir="$tree" "$@"
    ' inside "$directory" "$tree" "${CCACHE_DIR:-}" --ignore-environment \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/tmp LANG=C.UTF-8 \
        ${CCACHE_DIR:+CCACHE_DIR=/var/cache/ccache CCACHE_BASEDIR="${tree%/*}"} \
        ${CXX:+CXX="$CXX"} ${CMAKE_BUILD_PARALLEL_LEVEL:+CMAKE_BUILD_PARALLEL_LEVEL="$CMAKE_BUILD_PARALLEL_LEVEL"} \
        ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@" </dev/null
}
