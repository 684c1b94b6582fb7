#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs a recipe of scenes/farm with the real thing, and compares its files with those of a single
# run. Exits with 77 where the thing isn't installed.
# Usage: farm_test.sh SOURCE_FOLDER PROGRAM slurm|parallel|openjd
set -euo pipefail
source=$(realpath "$1")
program=$(realpath "$2")
recipe=$3
farm=$source/scenes/farm
folder=$(mktemp -d)
servers=()
finish() {
    if [ ${#servers[@]} -gt 0 ]; then kill "${servers[@]}" 2>/dev/null || true; fi
    wait
    rm -rf "$folder"
}
trap finish EXIT
cd "$folder"
mkdir bin whole parts
ln -s "$program" bin/voxelume
export PATH=$folder/bin:$PATH:/usr/sbin
export VOXELUME_CACHE_DIR=$folder/cache

need() {
    for name in "$@"; do
        command -v "$name" >/dev/null || { echo "there is no $name"; exit 77; }
    done
}

# A box that turns through 24 frames, each of which takes a while.
cat >scene.json <<'END'
{"voxelume": 1,
 "world": {"voxel_size": 0.1, "bounds": {"min": [0, 0, 0], "max": [3, 2, 1]}},
 "models": {"thing": {"shape": "box", "size": [1.2, 0.8, 0.4]}},
 "objects": [{"name": "thing", "model": "thing", "position": [1.5, 1, 0.5]}],
 "lights": [{"type": "directional", "direction": [0.2, -0.5, -1]}],
 "observer": {"position": [1.5, 1, 4], "look_at": [1.5, 1, 0.5],
              "display": {"shape": "pyramid", "angles": [45, 45]}},
 "render": {"size": [256, 256], "samples": 9},
 "animation": {"frames": 24, "tracks": [{"target": "objects.thing.turn",
     "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 24, "value": [90, 200, 40]}]}]}}
END
seconds() { date +%s.%N; }
told() {
    awk -v what="$1" -v from="$2" -v to="$(seconds)" \
        'BEGIN { printf "%s: %.1f s\n", what, to - from }'
}

render_whole() {
    local start
    start=$(seconds)
    voxelume render scene.json -q -o whole/f.####.exr
    told "24 frames, one run" "$start"
    start=$(seconds)
    voxelume render scene.json -q -o whole/one.exr --frames 7
    told "one frame of 64 rows of tiles, one run" "$start"
}

# refuse COMMAND...: expects that it ends with 2 before anything is rendered.
refuse() {
    local code=0
    "$@" >/dev/null 2>refusal.txt || code=$?
    if [ "$code" -ne 2 ] || [ ! -s refusal.txt ]; then echo "$* ends with $code" && exit 1; fi
}

# compare PATTERN: expects that the parts' files are the whole run's.
compare() {
    local count=0 file
    for file in whole/$1; do
        cmp "$file" "parts/${file#whole/}"
        count=$((count + 1))
    done
    [ "$count" -eq "$2" ] || { echo "$count files instead of $2"; exit 1; }
}

start_slurm() {
    local name
    name=$(hostname -s)
    mkdir -p slurm/ctld slurm/d
    cat >slurm/slurm.conf <<END
ClusterName=test
SlurmctldHost=$name(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$folder/slurm/ctld
SlurmdSpoolDir=$folder/slurm/d
SlurmctldPidFile=$folder/slurm/ctld.pid
SlurmdPidFile=$folder/slurm/d.pid
SlurmctldLogFile=$folder/slurm/ctld.log
SlurmdLogFile=$folder/slurm/d.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
KillWait=2
SchedulerParameters=bf_interval=1,sched_min_interval=0
GresTypes=gpu
NodeName=$name NodeAddr=127.0.0.1 CPUs=$(nproc) Gres=gpu:2 State=UNKNOWN
PartitionName=debug Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
    # Two character devices that every machine has stand for graphics cards.
    printf 'Name=gpu File=%s\n' /dev/null /dev/zero >slurm/gres.conf
    export SLURM_CONF=$folder/slurm/slurm.conf
    slurmctld -D -c -f "$SLURM_CONF" 2>/dev/null &
    servers+=($!)
    slurmd -D -N "$name" -f "$SLURM_CONF" 2>/dev/null &
    servers+=($!)
    for ((i = 0; i < 100; ++i)); do
        sinfo -h -o %T 2>/dev/null | grep -q idle && return
        sleep 0.2
    done
    cat slurm/*.log
    echo "Slurm doesn't start" && exit 1
}

# wait_for MERGE ARRAY: until both jobs are done; the merge must have succeeded.
wait_for() {
    for ((i = 0; i < 1500; ++i)); do
        [ -z "$(squeue -h -j "$1,$2" 2>/dev/null)" ] && break
        sleep 0.2
    done
    scontrol show job -o "$1" | grep -q 'JobState=COMPLETED' ||
        { scontrol show job -o "$1" || true; tail -n 3 voxelume-*.log; exit 1; }
}

# requeue_first ARRAY: kills a task that has finished a frame and works on its next one.
requeue_first() {
    for ((i = 0; i < 600; ++i)); do
        [ -e parts/f.0001.exr ] && break
        sleep 0.05
    done
    scontrol requeue "$1_1"
    cp -p parts/f.0001.exr kept.exr
    # Slurm would wait for two minutes.
    for ((i = 0; i < 100; ++i)); do
        squeue -h -j "$1_1" -o %T | grep -q PENDING && break
        sleep 0.1
    done
    scontrol update JobId="$1_1" StartTime=now
}

# Each task is a node with a cache of its own over one that all read, but for the third task, whose
# node has nothing. What tasks are told of graphics cards goes to cards.txt, and no further.
give_nodes_caches() {
    rm bin/voxelume
    cat >bin/voxelume <<END
#!/usr/bin/env bash
case \${SLURM_ARRAY_TASK_ID:-} in
    '') ;;
    3) VOXELUME_CACHE_DIR=$folder/cold ;;
    *) VOXELUME_CACHE_DIR=$folder/cache:$folder/node\$SLURM_ARRAY_TASK_ID ;;
esac
if [ -n "\${SLURM_JOB_GPUS:-}" ]; then
    echo "\$VOXELUME_DEVICE \$CUDA_VISIBLE_DEVICES" >>$folder/cards.txt
    unset VOXELUME_DEVICE CUDA_VISIBLE_DEVICES
fi
exec $program "\$@"
END
    chmod +x bin/voxelume
}

# The number of kernels that caches have.
kernels_in() {
    find "$@" -path '*programs*' -type f | wc -l
}

run_slurm() {
    need slurmctld slurmd sbatch
    render_whole
    start_slurm
    give_nodes_caches
    local start jobs
    start=$(seconds)
    read -r -a jobs < <("$farm/slurm_submit.sh" 8 scene.json -o parts/f.####.exr)
    requeue_first "${jobs[0]}"
    wait_for "${jobs[1]}" "${jobs[0]}"
    told "24 frames, 8 tasks, one requeued, one with a cold cache" "$start"
    scontrol show job -o "${jobs[0]}_1" | grep -q 'Restarts=1' ||
        { echo "no task began again"; exit 1; }
    [ "$(stat -c %Y.%y parts/f.0001.exr)" = "$(stat -c %Y.%y kept.exr)" ] ||
        { echo "a finished frame was rendered again"; exit 1; }
    compare 'f.*.exr' 24
    [ "$(kernels_in cold)" -gt 0 ] || { echo "the cold node compiled nothing"; exit 1; }
    [ "$(kernels_in node*)" -eq 0 ] || { echo "a warm node compiled again"; exit 1; }
    [ ! -e cards.txt ] || { echo "tasks have cards that nobody asked for"; exit 1; }
    start=$(seconds)
    read -r -a jobs < <(SBATCH_OPTIONS=--gres=gpu:1 "$farm/slurm_submit.sh" 8 scene.json \
        --frames 7 -o parts/one.exr)
    wait_for "${jobs[1]}" "${jobs[0]}"
    told "one frame of 64 rows of tiles, 8 tasks with a graphics card each" "$start"
    compare 'one*.exr' 1
    [ "$(grep -c "^gpu [01]$" cards.txt)" -eq 8 ] ||
        { echo "tasks don't render on the cards that they have:"; cat cards.txt; exit 1; }
}

run_parallel() {
    need parallel
    render_whole
    local start
    start=$(seconds)
    "$farm/parallel.sh" 8 parts/f.####.exr scene.json 2>/dev/null
    told "24 frames, GNU parallel" "$start"
    compare 'f.*.exr' 24
    "$farm/parallel.sh" 5 parts/one.exr scene.json --frames 7 2>/dev/null
    compare 'one*.exr' 1
    refuse "$farm/parallel.sh" 0 parts/one.exr scene.json
    refuse "$farm/parallel.sh" 2 'parts/{name}.exr' scene.json
    refuse "$farm/slurm_submit.sh" 08 scene.json -o parts/one.exr
    refuse "$farm/slurm_submit.sh" 8 scene.json -o 'parts/{name}.exr'
}

run_openjd() {
    need openjd
    openjd check "$farm/openjd.yaml"
    render_whole
    # shellcheck disable=SC2016 # nothing is to expand it
    local name hostile='a "$(touch $OWNED)" b.####.exr'
    export OWNED=$folder/owned
    for name in 'f.####.exr' "$hostile"; do
        local parameters=(--job-param "Scene=$folder/scene.json" --job-param "Folder=$folder/parts"
            --job-param "Output=$name" --job-param Parts=3)
        for step in Render Merge; do
            openjd run "$farm/openjd.yaml" --step "$step" "${parameters[@]}" >"$step.log" 2>&1 ||
                { cat "$step.log"; exit 1; }
        done
    done
    compare 'f.*.exr' 24
    cmp "whole/f.0002.exr" "parts/${hostile/\#\#\#\#/0002}"
    [ ! -e "$OWNED" ] || { echo "a name of files was run"; exit 1; }
}

"run_$recipe"
echo "all files are those of a single run"
