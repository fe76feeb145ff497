# sh exports.sh NM LIBRARY...: fails where a library exports anything but fmi2*, or does not export fmi2DoStep.
nm=$1
shift
for library in "$@"; do
    symbols=$("$nm" --dynamic --defined-only "$library" | sed 's/.* //')
    printf '%s\n' "$symbols" | grep -qx fmi2DoStep || { echo "$library: no fmi2DoStep" >&2; exit 1; }
    if printf '%s\n' "$symbols" | grep -v '^fmi2[A-Z]'; then
        echo "$library exports more than fmi2*" >&2
        exit 1
    fi
done
