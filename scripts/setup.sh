# Sourced by run.sh and test.sh: makes sure that this machine can build svbench and has a Vulkan driver.
#
# A driver that is already there and has tessellation and geometry shaders is used as it is. Otherwise
# Mesa's software driver is installed, where that is allowed; else this says what to install.

say() { printf '%s\n' "$*" >&2; }

# Runs a command as root, or fails if this user cannot become root without a question.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
        sudo -n "$@"
    else
        return 1
    fi
}

# install_packages WHAT PACKAGE...: installs Debian packages; apt options may be among them.
install_packages() {
    local what=$1
    shift
    if ! command -v apt-get >/dev/null; then
        say "svbench needs $what. Install it with your package manager and start again:"
        say "  Fedora: mesa-vulkan-drivers vulkan-loader gcc-c++; Arch: vulkan-swrast vulkan-icd-loader gcc"
        exit 1
    fi
    say "Installing $what: $*"
    if ! as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q "$@" >&2; then
        say "Could not install $what. As root, run: apt-get install $*"
        say "(on Debian 12 the driver is best taken from bookworm-backports: -t bookworm-backports)"
        exit 1
    fi
}

apt_updated=
apt_update() {
    [ -n "$apt_updated" ] && return
    apt_updated=yes
    if command -v apt-get >/dev/null; then as_root apt-get update -q >&2 || true; fi
}

need_compiler() {
    if ! command -v c++ >/dev/null; then
        apt_update
        install_packages "a C++ compiler (for the GLSL compiler)" g++
    fi
    if ! command -v cargo >/dev/null; then
        say "svbench needs a Rust toolchain (cargo). See https://rustup.rs"
        exit 1
    fi
}

# Debian 12's own Mesa lacks newer stages, so its driver comes from bookworm-backports, from the same
# mirror as the rest of the system.
enable_backports() {
    [ -r /etc/os-release ] || return 1
    [ "$(. /etc/os-release && echo "${VERSION_CODENAME:-}")" = bookworm ] || return 1
    if ! apt-cache policy | grep -q 'n=bookworm-backports'; then
        local mirror keyring=/usr/share/keyrings/debian-archive-keyring.gpg
        mirror=$(apt-get indextargets --format '$(SITE)' 'Codename: bookworm' | head -n 1)
        [ -n "$mirror" ] || return 1
        say "Enabling bookworm-backports"
        printf 'Types: deb\nURIs: %s\nSuites: bookworm-backports\nComponents: main\nSigned-By: %s\n' \
            "$mirror" "$keyring" |
            as_root tee /etc/apt/sources.list.d/bookworm-backports.sources >/dev/null || return 1
        as_root apt-get update -q >&2 || return 1
    fi
}

# has_device PROGRAM: whether the program finds a device with all stages.
has_device() {
    "$1" list devices --json 2>/dev/null | tr -d ' \n' | grep -q '"tessellation":true,"geometry":true,"unsuitable":null'
}

# need_device PROGRAM: makes sure that it finds one.
need_device() {
    has_device "$1" && return
    say "No Vulkan device with tessellation and geometry shaders found."
    apt_update
    if command -v apt-get >/dev/null && enable_backports; then
        install_packages "Mesa's software Vulkan driver" -t bookworm-backports mesa-vulkan-drivers libvulkan1
    else
        install_packages "Mesa's software Vulkan driver" mesa-vulkan-drivers libvulkan1
    fi
    if ! has_device "$1"; then
        say "Still no device; svbench sees:"
        "$1" list devices >&2
        exit 1
    fi
}

# The validation layers, for tests.
need_validation_layers() {
    local place
    for place in /usr/share/vulkan /etc/vulkan /usr/local/share/vulkan "${VULKAN_SDK:-/nonexistent}/share/vulkan"; do
        ls "$place"/explicit_layer.d/*khronos_validation*.json >/dev/null 2>&1 && return
        ls "$place"/explicit_layer.d/*validation*.json >/dev/null 2>&1 && return
    done
    apt_update
    install_packages "the Vulkan validation layers" vulkan-validationlayers
}
