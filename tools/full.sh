# shellcheck shell=bash
# What `./x setup --full` gets besides system packages (clang is one, see `full_things` in `./x`); sourced by `./x`.
#
# Packages are pinned in `tools/lock.tsv` (source, version, hash, licence), fetched by the ordinary client of their source, and
# unpacked into the project's own cache, nothing else is touched: `${BOSSAGE_TOOLS:-${XDG_CACHE_HOME:-~/.cache}/bossage/tools}/TOOL`.
# A folder there is whole or absent. Its `fetched.tsv` says what was wanted, what came, and the hash of that.
#
# To add a tool: a line in the lock, its name in `full_tools`, and three functions: `loss_without_TOOL` and `way_to_TOOL` (for the
# DISABLED line), and `unpack_TOOL PACKAGE FOLDER`, which leaves in the folder just what is needed. Programs in the folder's `bin` are
# linked from `bin` beside the folders, where `bossage` looks for them after the `PATH`.

full_tools="swiftshader dxc dawn"

tools_folder() { echo "${BOSSAGE_TOOLS:-${XDG_CACHE_HOME:-$HOME/.cache}/bossage/tools}"; }

# A column of a tool's line in the lock.
locked() {
    local column
    case $2 in
        source) column=2 ;;
        package) column=3 ;;
        version) column=4 ;;
        architecture) column=5 ;;
        sha256) column=6 ;;
        licence) column=7 ;;
    esac
    awk -F '\t' -v tool="$1" -v column="$column" '$1 == tool { print $column }' tools/lock.tsv
}

# Whether the cache has what the lock wants, or what was taken in its place.
is_fetched() {
    local record
    record=$(tools_folder)/$1/fetched.tsv
    [ -f "$record" ] && [ "$(cut -f 2 "$record")" = "$(locked "$1" version)" ]
}

hash_of() { sha256sum "$1" | cut -d ' ' -f 1; }

# Downloads a tool's package into an empty folder. Prints nothing; the folder then holds one file.
download() {
    case $(locked "$1" source) in
        debian) download_from_debian "$@" ;;
        pypi) download_from_pypi "$@" ;;
        npm) download_from_npm "$@" ;;
        *) say "setup: $1: tools/lock.tsv names no source that is known" && return 1 ;;
    esac
}

# The pinned version, else the one that Debian offers in its place: its archive drops versions with each point release. Both are
# checked against the archive's signature by apt itself.
download_from_debian() {
    local tool=$1 folder=$2 package version
    have apt-get || return 1
    package=$(locked "$tool" package)
    version=$(locked "$tool" version)
    is_for_this_machine "$tool" || version=
    if ! apt-cache show "$package" >/dev/null 2>&1; then as_root apt-get update -qq >&2 || return 1; fi
    apt_download "$folder" "$package${version:+=$version}" && return
    as_root apt-get update -qq >&2 || true
    apt_download "$folder" "$package${version:+=$version}" || apt_download "$folder" "$package"
}

apt_download() { (cd "$1" && apt-get download -qq -o APT::Sandbox::User=root "$2" >/dev/null 2>&1); }

# The pinned version or none: that index drops nothing. Pip itself refuses another hash, before it runs anything of the package.
download_from_pypi() {
    local tool=$1 folder=$2
    have python3 && python3 -m pip --version >/dev/null 2>&1 || return 1
    is_for_this_machine "$tool" || return 1
    printf '%s==%s --hash=sha256:%s\n' "$(locked "$tool" package)" "$(locked "$tool" version)" "$(locked "$tool" sha256)" \
        >"$folder.requirements"
    python3 -m pip --quiet --disable-pip-version-check download --no-deps --require-hashes \
        --dest "$folder" --requirement "$folder.requirements" >&2
}

# The pinned version or none: that index drops nothing either. Nothing of the package is run, and what npm keeps for itself goes with
# the work folder.
download_from_npm() {
    local tool=$1 folder=$2
    have npm || return 1
    is_for_this_machine "$tool" || return 1
    npm pack --silent --ignore-scripts --no-update-notifier --cache "$folder.cache" --pack-destination "$folder" \
        "$(locked "$tool" package)@$(locked "$tool" version)" >/dev/null
}

# Whether a pinned package is one for this processor, in the words of its source.
is_for_this_machine() {
    local here
    case $(locked "$1" source) in
        debian) here=$(dpkg --print-architecture 2>/dev/null) ;;
        pypi | npm) here=$(uname -m) ;;
    esac
    [ "$here" = "$(locked "$1" architecture)" ]
}

# The version of a downloaded package.
version_of() {
    case $(locked "$1" source) in
        debian) dpkg-deb -f "$2" Version ;;
        pypi | npm) locked "$1" version ;;
    esac
}

# Fetches one tool; on failure the cache is as it was.
fetch() {
    local tool=$1 tools work file wanted got hash
    tools=$(tools_folder)
    mkdir -p "$tools" || return 1
    work=$(mktemp -d "$tools/.$tool.XXXXXX") || return 1
    mkdir "$work/package" "$work/tool"
    if fetch_into "$tool" "$work"; then
        rm -rf "${tools:?}/$tool"
        mv "$work/tool" "$tools/$tool"
        link_programs "$tool"
        say "setup: $tool $got ($(locked "$tool" licence)) is in $tools/$tool"
        rm -rf "$work"
    else
        rm -rf "$work"
        return 1
    fi
}

link_programs() {
    local tools program
    tools=$(tools_folder)
    for program in "$tools/$1/bin/"*; do
        [ -x "$program" ] || continue
        mkdir -p "$tools/bin" && ln -sfn "../$1/bin/${program##*/}" "$tools/bin/${program##*/}"
    done
}

# Downloads, checks and unpacks into `$2/tool`; sets `got` for the caller's message.
fetch_into() {
    local tool=$1 work=$2
    say "setup: fetching $tool ($(locked "$tool" package), $(locked "$tool" source))"
    download "$tool" "$work/package" || return 1
    file=$(find "$work/package" -type f)
    [ -f "$file" ] || return 1
    wanted=$(locked "$tool" version)
    got=$(version_of "$tool" "$file")
    hash=$(hash_of "$file")
    if [ "$got" = "$wanted" ] && [ "$hash" != "$(locked "$tool" sha256)" ] && is_for_this_machine "$tool"; then
        say "setup: $tool: the package's hash is $hash, not the one in tools/lock.tsv; it is not used"
        return 1
    fi
    if [ "$got" != "$wanted" ]; then
        say "setup: $tool: version $wanted is no longer offered; took $got, sha256 $hash"
    fi
    "unpack_$tool" "$file" "$work/tool" || return 1
    printf '%s\t%s\t%s\t%s\n' "$tool" "$wanted" "$got" "$hash" >"$work/tool/fetched.tsv"
}

# Everything that is not there yet. Never fails: what could not be had is said, and the rest works without it.
setup_full() {
    local tool
    for tool in $full_tools; do
        if is_fetched "$tool" || fetch "$tool"; then continue; fi
        if [ -d "$(tools_folder)/$tool" ]; then
            say "setup: $tool: the wanted version could not be had; what is there stays in use"
            continue
        fi
        say "setup: DISABLED $("loss_without_$tool") ($tool is missing; $("way_to_$tool"))"
    done
    have python3 || say "setup: DISABLED route opengl (python3 is missing; on Debian: apt install python3 libegl1 libgl1-mesa-dri)"
    say "setup: DISABLED the check of HLSL for shader models 5.0 and 5.1 as such (fxc is missing; packages that bring it state no terms for it)"
}

# --- SwiftShader: a second Vulkan driver on the CPU, which comes with Chromium --------------------------------------------

loss_without_swiftshader() { echo "the second Vulkan driver: conform runs on the others alone"; }

way_to_swiftshader() {
    echo "on Debian ./x setup --full fetches it; elsewhere put libvk_swiftshader.so and vk_swiftshader_icd.json of a Chromium for your machine into $(tools_folder)/swiftshader"
}

unpack_swiftshader() {
    local member
    for member in usr/lib/chromium/libvk_swiftshader.so usr/lib/chromium/vk_swiftshader_icd.json usr/share/doc/chromium-common/copyright; do
        dpkg-deb --fsys-tarfile "$1" | tar -xOf - "./$member" >"$2/${member##*/}" || return 1
    done
}

# Shows the fetched driver to the Vulkan loader, unless whoever calls has chosen drivers. `bossage` does the same by itself.
show_swiftshader() {
    local manifest
    manifest=$(tools_folder)/swiftshader/vk_swiftshader_icd.json
    if [ -n "${VK_DRIVER_FILES+set}${VK_ICD_FILENAMES+set}${VK_ADD_DRIVER_FILES+set}" ]; then return; fi
    if [ -f "$manifest" ]; then export VK_ADD_DRIVER_FILES="$manifest"; fi
}

# --- DXC: Microsoft's compiler of HLSL, the library from a package that brings it, the program built here over it ---------

loss_without_dxc() { echo "route hlsl and the external check of HLSL"; }

way_to_dxc() { echo "put a dxc on the PATH, or have python3 with pip and g++ on x86-64 Linux and run ./x setup --full again"; }

# Of the package only the library, the two headers of its interface and the licence are used.
unpack_dxc() {
    local package=$1 folder=$2 inside parts
    have g++ || { say "setup: dxc: its program is built by g++, which is missing"; return 1; }
    inside=$(locked dxc package)-$(locked dxc version)
    parts=$inside/$(locked dxc package)/backends
    mkdir -p "$folder/bin" "$folder/lib" "$folder/include" || return 1
    member() { tar -xzOf "$package" "$1" >"$folder/$2"; }
    member "$parts/libdxcompiler_x86_64.so.3.7" lib/libdxcompiler.so \
        && member "$parts/WinAdapter.h" include/WinAdapter.h \
        && member "$parts/dxcapi.h" include/dxcapi.h \
        && member "$inside/LICENSE" LICENSE.package || return 1
    g++ -std=c++17 -O1 -I "$folder/include" -o "$folder/bin/dxc" crates/translate/tools/dxc.cpp -ldl >&2 || return 1
    "$folder/bin/dxc" --version >/dev/null
}

# --- Dawn: the WebGPU of Chromium, whose compiler is Tint; the library from a package that brings it, run by node --------------

loss_without_dawn() { echo "route tint and the external check of WGSL"; }

way_to_dawn() { echo "have node 20 or later and npm on the PATH, on x86-64 Linux, and run ./x setup --full again"; }

# Of the package only the library for Linux, its licence and its description are used; the program is ours.
unpack_dawn() {
    local package=$1 folder=$2
    have node || { say "setup: dawn: its program is run by node, which is missing"; return 1; }
    mkdir -p "$folder/bin" "$folder/lib" || return 1
    member() { tar -xzOf "$package" "package/$1" >"$folder/$2"; }
    member dist/linux-x64/dawn.node lib/dawn.node \
        && member package.json lib/package.json \
        && member LICENSE.md LICENSE.package || return 1
    cp crates/translate/tools/dawn.cjs "$folder/bin/dawn" && chmod +x "$folder/bin/dawn" || return 1
    "$folder/bin/dawn" --version >/dev/null
}
