#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A sweep as an array of Slurm: each task is a part, alone on its node.
#
#   sbatch --array=1-12 slurm.sh ARGUMENT...       as for hsr bench
#   hsr bench merge part*.ndjson -o all.ndjson     when all have ended
#
# A task that is ended by the machine is queued again, and goes on.
#SBATCH --exclusive
#SBATCH --requeue
#SBATCH --open-mode=append
exec hsr bench "$@" \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
  -o "part$SLURM_ARRAY_TASK_ID.ndjson" --resume
