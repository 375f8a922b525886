# Sourced by run.sh and test.sh: makes sure that this machine can build svbench and has a Vulkan driver, as far as
# possible before the build, which takes minutes.
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

# Whether this is Debian 12, whose own Mesa lacks newer stages.
is_bookworm() {
    [ -r /etc/os-release ] && [ "$(. /etc/os-release && echo "${VERSION_CODENAME:-}")" = bookworm ]
}

# The mirror that this system takes its packages from.
mirror() {
    local site
    site=$(apt-get indextargets --format '$(SITE)' 'Codename: bookworm' 2>/dev/null | head -n 1)
    printf '%s\n' "${site:-http://deb.debian.org/debian}"
}

backports_source=/etc/apt/sources.list.d/bookworm-backports.sources
has_backports() { apt-cache policy | grep -q 'n=bookworm-backports'; }
backports_text() {
    printf 'Types: deb\nURIs: %s\nSuites: bookworm-backports\nComponents: main\nSigned-By: %s\n' \
        "$(mirror)" /usr/share/keyrings/debian-archive-keyring.gpg
}

# install_packages WHAT PACKAGE...: installs Debian packages; `-t bookworm-backports` may be among them.
# Where that is not possible, says what to run and ends the script.
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
        say ""
        say "svbench needs $what, and this user may not install it. As root, run:"
        if [ "$1" = -t ] && ! has_backports; then
            say "cat > $backports_source <<'END'"
            say "$(backports_text)"
            say "END"
        fi
        say "apt-get update"
        say "apt-get install -y $*"
        say "and start again."
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
    if ! command -v cargo >/dev/null; then
        say "svbench needs a Rust toolchain (cargo). See https://rustup.rs"
        exit 1
    fi
    if ! command -v c++ >/dev/null; then
        apt_update
        install_packages "a C++ compiler (for the GLSL compiler)" g++
    fi
}

# Installs Mesa's software driver; on Debian 12 from bookworm-backports, of the same mirror as the rest of the
# system.
install_driver() {
    local from=()
    apt_update
    if command -v apt-get >/dev/null && is_bookworm; then
        from=(-t bookworm-backports)
        if ! has_backports; then
            if backports_text | as_root tee "$backports_source" >/dev/null; then
                say "Enabled bookworm-backports"
                as_root apt-get update -q >&2 || true
            fi
        fi
    fi
    install_packages "a Vulkan driver (Mesa's software driver will do)" "${from[@]}" mesa-vulkan-drivers libvulkan1
}

# Whether any Vulkan driver is installed, where the Vulkan loader looks for them. Says nothing about what it can
# do: that the program finds out once it is built.
has_driver() {
    local data=${XDG_DATA_HOME:-${HOME:-}/.local/share} config=${XDG_CONFIG_HOME:-${HOME:-}/.config}
    local named=${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}} folder file folders
    IFS=: read -ra folders <<<"$named:${VK_ADD_DRIVER_FILES:-}"
    if [ -z "$named" ]; then
        local dirs
        IFS=: read -ra dirs <<<"$config:${XDG_CONFIG_DIRS:-/etc/xdg}:/etc:$data:${XDG_DATA_DIRS:-/usr/local/share:/usr/share}"
        for folder in "${dirs[@]}"; do folders+=("$folder/vulkan/icd.d"); done
    fi
    # A file or a folder of them.
    for folder in "${folders[@]}"; do
        # Variables that are not set leave empty names.
        [ -n "$folder" ] || continue
        for file in "$folder" "$folder"/*.json; do
            case $file in *.json) [ -r "$file" ] && return 0 ;; esac
        done
    done
    return 1
}

# Before the build, which takes minutes: without any driver, one is needed for certain.
need_driver() {
    has_driver && return
    say "No Vulkan driver found."
    install_driver
}

# has_device PROGRAM: whether the program finds a device with all stages.
has_device() {
    "$1" list devices --json 2>/dev/null | tr -d ' \n' |
        grep -q '"tessellation_stage":true,"geometry_stage":true,[^}]*},"unsuitable":null'
}

# need_device PROGRAM: makes sure that it finds one.
need_device() {
    has_device "$1" && return
    say "No Vulkan device with tessellation and geometry shaders found."
    install_driver
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
