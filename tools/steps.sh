# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by .ci/run and tools/nightly: runs steps one after the other, whatever became of those before, and reports.

failed=() skipped=() times=()

# step NAME COMMAND...: the exit code 77 says that it cannot be done here.
step() {
    local name=$1 start=$SECONDS status=0
    shift
    echo "=== $name"
    "$@" || status=$?
    case $status in
        0) ;;
        77) skipped+=("$name") ;;
        *) failed+=("$name") ;;
    esac
    times+=("$(printf '%5d s  %s' $((SECONDS - start)) "$name")")
}

# How long each step took, and what did not pass; fails if one did.
report_steps() {
    printf '=== %s\n' "${times[@]}"
    ((${#skipped[@]} == 0)) || printf '=== SKIPPED: %s\n' "${skipped[@]}"
    if ((${#failed[@]} > 0)); then
        printf '=== FAILED: %s\n' "${failed[@]}"
        return 1
    fi
    echo "=== all passed in $SECONDS s"
}
