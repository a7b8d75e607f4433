#!/usr/bin/env bash
# submit.sh FILE PARTS OPTIONS_OF_SWEEP...: the sweep in so many tasks, then its parts merged to FILE. ARRAY=3,5-7 has
# these parts alone computed, where some are missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 3 ] || { echo "submit.sh FILE PARTS OPTIONS_OF_SWEEP..." >&2; exit 2; }
file=$1 parts=$2
shift 2
folder="$file.parts"
mkdir -p "$folder"
array=$(sbatch --parsable --array="${ARRAY:-1-$parts}" --output="$folder/task-%a.log" \
  "$here/sweep.sbatch" "$folder" "$parts" "$@")
merge=$(sbatch --parsable --dependency=afterok:"$array" --kill-on-invalid-dep=yes \
  --output="$folder/merge.log" "$here/merge.sbatch" "$folder" "$parts" "$file")
echo "$array $merge"
