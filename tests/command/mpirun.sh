# SPDX-License-Identifier: GPL-3.0-or-later
# For the tests that run hsr on several ranks, in a folder of their own.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1

# Whether there are ranks.
have_ranks() {
  [ -x "$(dirname "$hsr")/hsr-ranks.so" ] && command -v mpirun >/dev/null
}

# on RANKS ARGUMENT...: hsr on so many ranks, which must not hang.
on() {
  n_ranks=$1
  shift
  timeout 120 mpirun -n "$n_ranks" "$hsr" "$@" >out 2>err </dev/null && return
  status=$?
  # mpirun may report that a rank exited improperly, although it ended well. It
  # then names PID 0, about once in a thousand runs (open-mpi/ompi#7833).
  grep -q 'with PID 0 on' err || return $status
  timeout 120 mpirun -n "$n_ranks" "$hsr" "$@" >out 2>err </dev/null
}
