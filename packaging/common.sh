# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# What packaging/run and packaging/test share. Sourced; the caller has set -euo pipefail.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
dependencies=$root/packaging/dependencies

fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

# The requirements of some sections of packaging/dependencies, one a line, alternatives between "|", a "?"
# behind what not every release has.
requirements() {
  local section wanted=" $* " line
  while read -r line; do
    line=${line%%#*}
    if [[ $line =~ ^\[(.*)\] ]]; then
      section=${BASH_REMATCH[1]}
    elif [[ $line =~ [^[:space:]] && $wanted == *" $section "* ]]; then
      echo "$line"
    fi
  done <"$dependencies"
}

# One package per unmet requirement: the first alternative that the release offers, else the first. The package
# lists are asked once for all of them: every call of apt-cache reads them from the beginning, which takes a second.
missingPackages() {
  local wanted line name requirement package alternatives choice
  local -A isInstalled=() isOffered=()
  wanted=$(requirements "$@")
  while read -r line name; do
    [[ $line == ?i* ]] && isInstalled[$name]=1
  done < <(dpkg-query --show --showformat='${db:Status-Abbrev}\t${Package}\n')
  while IFS= read -r line; do
    if [[ $line =~ ^([^ ].*):$ ]]; then
      name=${BASH_REMATCH[1]}
    elif [[ $line =~ Candidate:\ [^\(] ]]; then
      isOffered[$name]=1
    fi
  done < <(tr -s ' |?' '\n' <<<"$wanted" | LC_ALL=C xargs -r apt-cache policy 2>/dev/null)
  while read -r requirement; do
    read -ra alternatives <<<"${requirement//|/ }"
    choice=
    if [[ ${alternatives[-1]} == "?" ]]; then
      [[ -v isOffered[${alternatives[0]}] ]] || continue
      unset 'alternatives[-1]'
    fi
    for package in "${alternatives[@]}"; do
      if [[ -v isInstalled[$package] ]]; then continue 2; fi
    done
    for package in "${alternatives[@]}"; do
      if [[ -v isOffered[$package] ]]; then choice=$package && break; fi
    done
    echo "${choice:-${alternatives[0]}}"
  done <<<"$wanted"
}

# Runs a command as root: directly, or through sudo, which may ask for the password only at a terminal.
asRoot() {
  if ((EUID == 0)); then "$@"; else sudo "$@"; fi
}
canBeRoot() {
  ((EUID == 0)) && return
  command -v sudo >/dev/null || return
  sudo -n true 2>/dev/null || { [[ -t 0 && -t 2 ]] && sudo -v; }
}

aptInstall() {
  asRoot env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get install --yes --no-install-recommends \
    --no-upgrade --no-remove -o DPkg::Lock::Timeout=300 "$@"
}

# The programs here that install take no options.
refuseOptions() {
  (($# == 0)) || fail "there is no option $1; call it without any."
}

# Installs what is missing of some sections, as `apt install` would: with the newer versions of installed packages
# that the missing ones ask for, named before anything is done; nothing else is upgraded and nothing is removed.
installDependencies() {
  [[ -n $(command -v apt-get) && -n $(command -v dpkg-query) ]] ||
    fail "this is no Debian: install what packaging/dependencies names by other means and build with CMake."
  local missing log=$root/build/install.log
  mapfile -t missing < <(missingPackages "$@")
  ((${#missing[@]})) || return 0
  canBeRoot || fail "these packages are missing and neither root nor sudo is at hand to install them;" \
    "have an administrator run: apt-get install --no-install-recommends ${missing[*]}"

  mkdir -p "$root/build"
  echo "Installing ${#missing[@]} packages: ${missing[*]}"
  asRoot apt-get update >"$log" 2>&1 || { cat "$log" >&2; fail "the package lists could not be brought up to date."; }
  mapfile -t missing < <(missingPackages "$@")  # the lists may have named other alternatives

  local plan upgrades
  plan=$(aptInstall --simulate "${missing[@]}" 2>&1) ||
    { echo "$plan" >&2; fail "the distribution cannot install ${missing[*]} beside what is there."; }
  upgrades=$(sed -n 's/^Inst \([^ ]*\) \[.*/\1/p' <<<"$plan" | tr '\n' ' ')
  [[ -z $upgrades ]] || echo "They need newer versions of these, which are brought up to date: ${upgrades% }"
  aptInstall "${missing[@]}" >>"$log" 2>&1 || { cat "$log" >&2; fail "installing ${missing[*]} failed."; }
}

# As many compilers as there are cores, and no more than memory bears at 1.5 GB each.
compileJobs() {
  local cores gigabytesTimesTwo jobs
  cores=$(nproc)
  gigabytesTimesTwo=$(awk '/^MemAvailable/ {print int($2 / 524288)}' /proc/meminfo)
  jobs=$((gigabytesTimesTwo / 3 < cores ? gigabytesTimesTwo / 3 : cores))
  echo $((jobs > 1 ? jobs : 1))
}

# Turns Ninja's lines into one line that moves on a terminal, else into a line every tenth.
showBuildProgress() {
  local name=$1 line announced=-1 tenth
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    ((BASH_REMATCH[1] > 0)) || continue
    if [[ -t 1 ]]; then
      printf '\rBuilding %s: %d of %d ' "$name" "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
      announced=1
      continue
    fi
    tenth=$((BASH_REMATCH[1] * 10 / BASH_REMATCH[2]))
    ((tenth == announced)) && continue
    announced=$tenth
    echo "Building $name: $((tenth * 10)) %"
  done
  if [[ -t 1 ]] && ((announced > 0)); then echo; fi
}

# build PRESET [TARGET...]: configures and builds; silent when nothing has changed, the log only on failure.
# $RELUCENT_WARNINGS_ARE_ERRORS: ON where no warning is to pass; else a stranger's newer compiler may warn.
# $RELUCENT_TEST_OBJECTS: a build with the tests' own objects, which are taken from there.
build() {
  local preset=$1 log=$root/build/$1.log targets=()
  local options=(${RELUCENT_WARNINGS_ARE_ERRORS:+"-DRELUCENT_WARNINGS_ARE_ERRORS=$RELUCENT_WARNINGS_ARE_ERRORS"})
  [[ -z ${RELUCENT_TEST_OBJECTS:-} ]] || options+=("-DRELUCENT_TEST_OBJECTS=$RELUCENT_TEST_OBJECTS")
  shift
  (($#)) && targets=(--target "$@")
  mkdir -p "$root/build"
  (cd "$root" && cmake --preset "$preset" "${options[@]}") >"$log" 2>&1 ||
    { cat "$log" >&2; fail "configuring $preset failed, see above (build/$preset.log)."; }
  (cd "$root" && cmake --build --preset "$preset" --parallel "$(compileJobs)" "${targets[@]}") 2>&1 |
    tee -a "$log" | showBuildProgress "$preset" ||
    { grep -v '^\[[0-9]*/[0-9]*\]' "$log" | tail -n 100 >&2
      fail "building $preset failed, see above (the whole log: build/$preset.log)."; }
}
