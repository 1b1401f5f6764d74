#!/bin/bash
# The cases of a plan as a Slurm array: each task a chunk of cases, and after all of them one that merges.
#
#   slurm_cases.sh plan.toml out 100        submit: chunks of 100 cases
#
# A task that fails or is killed may be submitted again by the same words: parts that are there are left alone.
#SBATCH --ntasks=1 --cpus-per-task=1 --requeue
set -euo pipefail
plan=$1 out=$2 chunk=$3
program=${ALE_GEAR:-ale-gear}
parts=$out.parts

if [ "${4:-}" = merge ]; then
    exec "$program" merge "$plan" "$parts"/*.csv --out "$out"
elif [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
    from=$((SLURM_ARRAY_TASK_ID * chunk))
    cases=$from..$((from + chunk))
    exec "$program" --quiet -j "${SLURM_CPUS_PER_TASK:-1}" vary "$plan" --cases "$cases" --out "$parts/$cases.csv"
fi
mkdir -p "$parts"
count=$("$program" vary "$plan" --list "$chunk" | wc -l)
job=$(sbatch --parsable --array=0-$((count - 1)) "$0" "$plan" "$out" "$chunk")
sbatch --dependency=afterok:"$job" "$0" "$plan" "$out" "$chunk" merge
