# SPDX-License-Identifier: GPL-3.0-or-later
# Reads tests/table, which says what tests what.
package table;
use strict;
use warnings;
use Exporter 'import';
use File::Basename;
use Cwd 'abs_path';
our @EXPORT_OK = qw(rows tests_of_module tests_of_file targets_of command_of);

my $here = dirname(abs_path(__FILE__));
my @rows;

sub rows {
  return @rows if @rows;
  open my $in, '<', "$here/table" or die "tests/table: $!\n";
  while (<$in>) {
    chomp;
    next if /^\s*(#|$)/;
    my @part = split /\s*\|\s*/, $_, -1;
    die "tests/table:$.: a row has three parts\n" unless @part == 3;
    push @rows, {files => [split ' ', $part[0]], modules => [split ' ', $part[1]],
                 tests => [split ' ', $part[2]]};
  }
  return @rows;
}

sub matches {
  my ($row, $file) = @_;
  for (@{$row->{files}}) {
    my $name = join '[^/]*', map { quotemeta } split /\*/, $_, -1;
    return 1 if m{/$} ? $file =~ m{(?:^|/)$name} : $file =~ m{(?:^|/)$name\.\w+$};
  }
  return 0;
}

# The tests of some rows, each once, with these modules in place of @.
sub tests_of {
  my ($modules, @of) = @_;
  my (@tests, %seen);
  for (map { @{$_->{tests}} } @of) {
    my $list = join /^check/ ? ',' : ':', @$modules;
    (my $test = $_) =~ s/\@/$list/;
    $test =~ s/:$//;
    push @tests, $test unless $seen{$test}++;
  }
  return @tests;
}

sub is_each { my ($row) = @_; return "@{$row->{modules}}" eq 'each'; }

sub tests_of_module {
  my ($module) = @_;
  my @of = grep { my $row = $_; is_each($row) || grep { $_ eq $module } @{$row->{modules}} }
           rows();
  return tests_of([$module], @of);
}

sub tests_of_file {
  my ($file) = @_;
  my @of = grep { matches($_, $file) } rows();
  my %seen;
  my @modules = grep { !$seen{$_}++ } map { @{$_->{modules}} } grep { !is_each($_) } @of;
  return tests_of(\@modules, @of);
}

# --- How to make and run tests -----------------------------------------------

my $scenes = 'house cyclic-overlap penetration coplanar near-plane lattice:40:3 ' .
             'grid:4 --views 2 -s 41x29';
my $in_parallel = 'soup:3000:1 penetration lattice:40:3 sliver ' .
                  '--parallel same --views 6 -s 97x61';

# What make has to make for these tests, besides what they start by themselves.
sub targets_of {
  my (@tests) = @_;
  my %targets;
  for (@tests) {
    my ($test) = split /:/;
    $targets{$test =~ /\.test$|^check/ ? 'hsr' : "tests/$test"} = 1;
    my ($folder) = $test =~ m{^([^/]*)/} or next;
    $targets{'hsr'} = $targets{"tests/$folder/hsr-fixtures"} = 1 if -e "$here/$folder/fixtures.c";
    $targets{'tests/answers/hsr-layers'} = 1 if $folder eq 'answers';
    $targets{'tests/example/hsr-example'} = 1 if $folder eq 'example';
    $targets{'reports/page/lesson.html'} = 1 if $folder eq 'lesson';
    $targets{'reports/page/report.js'} = 1 if $folder eq 'report';
    $targets{'tests/export/read_cells'} = 1 if $folder eq 'export';
    $targets{'tests/view/close_window'} = 1 if $folder eq 'view';
  }
  return sort keys %targets;
}

# The command of a test, for a shell in the folder of a build.
sub command_of {
  my ($test, $source) = @_;
  my ($program, @words) = split /:(?![a-z-]+=)/, $test; # a variant is one word
  my $run = $program =~ /\.test$/ ? "env @words '$source/tests/$program'"
          : $program eq 'check' ? "./hsr check $scenes" . (@words ? " -a @words" : '')
          : $program eq 'check-parallel' ? "./hsr check $in_parallel -a @words"
          : "./tests/$program @words";
  return "HSR=\$PWD/hsr HSR_SOURCE='$source' HSR_BUILD=\$PWD $run";
}

1;
