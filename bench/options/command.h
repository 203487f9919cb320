/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The subcommands of hsr: one in each file command.c of a folder, and in each
 * other file of bench/ itself. */
#ifndef HSR_BENCH_OPTIONS_COMMAND_H
#define HSR_BENCH_OPTIONS_COMMAND_H

#include "common/base/status.h"

/* A subcommand. argv[0] is its name. HSR_E_DIFFERENCE ends the program with
 * status 1 and without a message. Any other failure ends it with the message in
 * *err. */
struct hsr_command {
  const char *name;
  const char *about; /* for --help; NULL: --help does not show it */
  enum hsr_status (*run)(int argc, char **argv, struct hsr_error *err);
};

enum hsr_status command_list(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_scenes(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_stats(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_times(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_tables(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_render(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_view(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_export(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_generate(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_check(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_judge(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_bench(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_report(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_trace(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_lesson(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_lab(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_voxels(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_areas(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_errors(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_suite(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_worker(int argc, char **argv, struct hsr_error *err);

#endif
