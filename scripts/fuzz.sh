#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# fuzz.sh MINUTES [TARGET...]: builds the fuzzers (libFuzzer; address and undefined behaviour
# sanitizers), runs all or these targets in turn, for so many minutes or 1e7 executions each, and
# prints executions, processor time, coverage and finds. The corpus stays in build/fuzz/corpus for
# the next call; finds (crashes, leaks, inputs of over 30 s) are in build/fuzz/finds. Exit code 1 if
# there are any. A find, made small with -minimize_crash=1, goes into tests/fuzz/corpus/TARGET.
# fuzz.sh --list prints the targets.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# Folder of each target's corpus.
declare -A corpora=([triangle]=geometry/fuzz/corpus [lmd]=methods/fuzz/corpus)
readers=(off ply obj import tum experiment path manifest sweep journal result)
for reader in "${readers[@]}"; do corpora[$reader]="fuzz/corpus/$reader"; done
all=("${readers[@]}" triangle lmd)
if [[ ${1:-} == --list ]]; then
  printf '%s\n' "${all[@]}"
  exit 0
fi
[[ ${1:-} =~ ^[0-9]+$ && $1 -gt 0 ]] || die 2 "no number of minutes (remedy: ./scripts/fuzz.sh 10, or ./scripts/fuzz.sh 10 off tum)"
minutes="$1"
shift
if ! command -v clang++ >/dev/null ||
  [[ ! -e "$(clang++ -print-resource-dir)/lib/linux/libclang_rt.fuzzer-$(uname -m).a" ]]; then
  die "$EXIT_ENVIRONMENT" "there is no clang with libFuzzer (remedy: apt-get install clang libclang-rt-14-dev)"
fi
readonly EXECUTIONS=10000000 INTERRUPTED=72
targets=("$@")
(($# > 0)) || targets=("${all[@]}")
for target in "${targets[@]}"; do
  [[ -n ${corpora[$target]:-} ]] || die 2 "there is no target '$target' (remedy: choose of ${all[*]})"
done

build="$ROOT/build/fuzz"
(cd "$ROOT" && cmake --preset fuzz >/dev/null && cmake --build --preset fuzz --parallel "$JOBS") >&2
mkdir -p "$build/finds" "$build/logs"
# Leaks: under sanitizers libraries of the distribution may keep memory of their first call. One
# caller per allocation instead of thirty saves a seventh of some targets' time; a find repeated by
# hand shows all. 1 MB of freed memory stays out of use: more than one execution frees, and in the
# cache. Fresh memory is not filled.
export ASAN_OPTIONS="${ASAN_OPTIONS:-detect_leaks=0:allocator_may_return_null=1:malloc_context_size=1:quarantine_size_mb=1:thread_local_quarantine_size_kb=64:max_malloc_fill_size=0}"
# Each execution writes a new file for readers of named files: to memory, if there is such a place.
[[ ! -d /dev/shm ]] || export TMPDIR=/dev/shm
# A find must repeat. Others come from a child process, whose crash in HDF5 or assimp is allowed but
# writes a find, or from an input that was slow on a busy machine.
drop_what_does_not_repeat() {
  local find scratch
  scratch="$(mktemp -d)"
  for find in "$build/finds/$1"-*; do
    [[ -e $find ]] || continue
    if "$build/lmdbench_$1_fuzz" "$find" -timeout=30 -artifact_prefix="$scratch/" >/dev/null 2>&1 </dev/null; then
      rm "$find"
    fi
  done
  rm -rf "$scratch"
}
found=0 idle=0
printf '%-12s %14s %10s %10s %10s %8s %6s\n' target executions cpu_s edges corpus exec/s finds
for target in "${targets[@]}"; do
  corpus="$build/corpus/$target"
  log="$build/logs/$target.log"
  longest=8192
  case $target in
  result) longest=16384 ;; # the smallest results of its corpus are longer than 8 KB
  # Longer documents take time and cover no more.
  path | journal) longest=2048 ;;
  manifest) longest=330 ;; # one mesh takes 290
  experiment | sweep) longest=256 ;;
  esac
  mkdir -p "$corpus"
  : >"$log"
  # No -entropic: with thousands of files its bookkeeping takes a third of the time.
  # Lines of two numbers in the log are processor time, less than elapsed time on a busy machine.
  TIMEFORMAT='%U %S'
  end=$((SECONDS + minutes * 60)) status=1
  while ((status != 0 && SECONDS < end)); do
    { time "$build/lmdbench_${target}_fuzz" "$corpus" "$ROOT/tests/${corpora[$target]}" \
      -max_total_time=$((end - SECONDS)) -runs=$EXECUTIONS -timeout=30 -rss_limit_mb=4096 -max_len="$longest" \
      -entropic=0 -print_final_stats=1 -artifact_prefix="$build/finds/$target-" 2>&1 </dev/null; } >>"$log" 2>&1 && status=0 || status=$?
    # SIGINT ends a target early but well. A find ends libFuzzer (exit code and file); one that does
    # not repeat, such as a timeout on a busy machine, does not count, and the target continues.
    ((status != INTERRUPTED)) || status=0
    drop_what_does_not_repeat "$target"
    finds="$(find "$build/finds" -name "$target-*" | wc -l)"
    ((finds == 0)) || break
  done
  found=$((found + finds))
  grep -q '^stat::number_of_executed_units: *[1-9]' "$log" || { say "$target: nothing was executed, see $log"; idle=1; }
  awk -v target="$target" -v finds="$finds" '
    / cov: / { for (i = 1; i < NF; ++i) { if ($i == "cov:") edges = $(i + 1); if ($i == "corp:") corpus = $(i + 1) } }
    /^stat::number_of_executed_units/ { executions += $2 }
    /^[0-9]+[.][0-9]+ [0-9]+[.][0-9]+$/ { seconds += $1 + $2 }
    /^stat::average_exec_per_sec/ { rate = $2 }
    END { printf "%-12s %14d %10s %10d %10s %8d %6d\n", target, executions, seconds, edges, corpus, rate, finds }' "$log"
done
((found == 0)) || say "finds are in $build/finds, what led to them in $build/logs"
((found == 0 && idle == 0))
