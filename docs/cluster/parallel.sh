#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A sweep on several machines, by GNU parallel over ssh.
#
#   parallel.sh HOSTS PARTS ARGUMENT...     as: parallel.sh a,b,c 12 'mesh:*' -T 1
#
# HOSTS is as for --sshlogin: "a,b", or ":" for this machine alone. hsr and the
# folder are the same on all. Each machine does one part at a time, so that
# nothing else disturbs its times. If it is ended, the same command goes on. In
# the end all.ndjson holds the records.
set -u
hosts=$1 parts=$2
shift 2
parallel --sshlogin "$hosts" --jobs 1 --workdir . --quote \
  hsr bench "$@" --shard "{}/$parts" -o "part{}.ndjson" --resume \
  ::: $(seq "$parts")
# hsr bench ends with 1 if something was found to be wrong; that is no reason
# not to put the parts together.
hsr bench merge $(seq -f part%.0f.ndjson "$parts") -o all.ndjson
