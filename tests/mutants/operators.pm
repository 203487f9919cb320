# SPDX-License-Identifier: GPL-3.0-or-later
# The mutants of a source: what changes, where, and under what name.
package operators;
use strict;
use warnings;
use Exporter 'import';
our @EXPORT_OK = qw(mutants_of change);

our %kinds = (
  turned    => 'a comparison is turned round',
  bound     => 'a bound is moved by one: < is <=, > is >=',
  one       => '+ 1 or - 1 is left out',
  last      => 'a loop leaves out its last round',
  out       => 'a statement is left out',
  true      => 'a condition always holds',
  false     => 'a condition never holds',
  not       => 'a condition is negated',
  part      => 'one operand of && or || is left out',
  and       => '&& is ||, || is &&',
  choice    => 'of A ? B : C always B, or always C',
  arithmetic => '+ is -, * is /',
  bits      => '& is |, << is >>',
  step      => '++ is --, += is -=',
  sign      => 'a minus is left out',
  constant  => 'a number is another one',
  name      => 'a name is its opposite: x0 is x1, lo is hi, true is false',
  arguments => 'the first two arguments are exchanged',
  index     => 'an index is 0',
);

my %turned = ('<' => '>', '>' => '<', '<=' => '>=', '>=' => '<=',
              '==' => '!=', '!=' => '==');
my %bound = ('<' => '<=', '<=' => '<', '>' => '>=', '>=' => '>');
my %arithmetic = ('+' => '-', '-' => '+', '*' => '/', '/' => '*');
my %and = ('&&' => '||', '||' => '&&');
my %bits = ('&' => '|', '|' => '&', '<<' => '>>', '>>' => '<<');
my %step = ('++' => '--', '--' => '++', '+=' => '-=', '-=' => '+=',
            '|=' => '&=', '&=' => '|=');
my @opposite = qw(x0 x1 y0 y1 lo hi left right first last near far above below
                  min max begin end fmin fmax hsr_min hsr_max floor ceil inf sup
                  true false front back nearest farthest INFINITY 0 from to
                  HSR_YES HSR_NO NEARER FARTHER FRONT BEHIND LEFT RIGHT INSIDE OUTSIDE);
my %opposite = (@opposite, reverse @opposite);
delete $opposite{0};

# Control words, which look like calls; and words that begin what is no statement
# of its own.
my $control = qr/^(?:if|for|while|switch|catch|return|sizeof|else|do|case|default)$/;
my $declares = qr/^(?:const|static|struct|enum|union|auto|using|typedef|return|goto
                     |case|default|else|do|throw|delete|constexpr|template|public
                     |private)\b/x;

# The text with blanks in place of comments, of what strings hold, and of lines
# of the preprocessor. Every character stays at its place.
sub blank { my ($t) = @_; $t =~ s/[^\n]/ /g; return $t; }
sub mask {
  my ($text) = @_;
  my $comment = qr{/\*.*?\*/|//[^\n]*}s;
  my $string = qr{"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+'}s;
  my $preprocessor = qr{^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*}m;
  $text =~ s{($comment)|($string)|($preprocessor)}
            {defined $2 ? substr($2, 0, 1) . blank(substr($2, 1, -1)) . substr($2, -1)
                        : blank($1 // $3)}eg;
  return $text;
}

# The place after what a parenthesis at $at encloses.
sub after_group {
  my ($masked, $at) = @_;
  pos($$masked) = $at;
  return $$masked =~ /\G(\((?:[^()]++|(?1))*\))/g ? $at + length $1 : undef;
}

# What a brace opens, after these words: the body of a function or a table of
# numbers, with its name; a list, of a declaration that goes on after it; or
# something else.
sub opened_by {
  my ($words) = @_;
  my $type = qr/int|double|float|unsigned|char|bool|size_t|\w+_t/;
  return ('body', $1) if $words =~ /\b$type\b[^=(]*?(\w+)\s*\[[^=]*=\s*$/;
  return 'list' if $words =~ /=\s*$/ || ($words =~ /\)\s*:[^:]/ && $words =~ /[\w>]\s*$/);
  my $after = qr/(?:const|noexcept|override|\s)*(?::[^:].*|->[^;]*)?/s;
  return 'other' unless $words =~ /\)\s*$after$/;
  $words =~ s/__attribute__\s*\(\(.*?\)\)//gs;
  $words =~ s/\btemplate\s*<[^{}]*?>\s*(?=[a-z])//s;
  return $words =~ /(~?\w+|operator\S+)\s*\((?!\()/ ? ('body', $1) : 'other';
}

# The bodies of functions, and the tables of numbers, as [name, begin, end].
sub bodies {
  my ($masked) = @_;
  my (@open, @found);
  my $head = 0; # where the words before the next brace begin
  while ($$masked =~ /([{};])/g) {
    my ($c, $at) = ($1, pos($$masked) - 1);
    my $inside = @open && $open[-1]{kind} eq 'body';
    if ($c eq ';') {
      $head = $at + 1 unless $inside;
    } elsif ($c eq '{') {
      my ($kind, $name) = $inside ? 'body' : opened_by(substr($$masked, $head, $at - $head));
      push @open, {kind => $kind, name => $name, begin => $at, inside => $inside};
      $head = $at + 1 unless $inside || $kind eq 'list';
    } elsif (my $closed = pop @open) {
      next if $closed->{inside};
      push @found, [$closed->{name}, $closed->{begin}, $at] if $closed->{kind} eq 'body';
      $head = $at + 1 unless $closed->{kind} eq 'list';
    }
  }
  return @found;
}

# --- The changes of one body --------------------------------------------------
#
# Each of these takes a body and gives its changes to add_change: a kind, the
# place in the body, the length of what is replaced, and the new text. $b->{code}
# is the body with blanks as above, $b->{text} as it stands in the source.

sub add_change {
  my ($b, @change) = @_;
  push @{$b->{changes}}, \@change;
}

my $group = qr/(\((?:[^()]++|(?-1))*\))/;

# An operator of two operands has blanks on both sides.
sub change_operators {
  my ($b) = @_;
  while ($b->{code} =~ m{(?<=[ ])(<=|>=|==|!=|<<|>>|&&|\|\||[-+*/&|]=|[-+*/<>&|])(?=[ \n])
                         |(\+\+|--)}gx) {
    my ($op, $at) = defined $1 ? ($1, $-[1]) : ($2, $-[2]);
    my %new = (turned => $turned{$op}, bound => $bound{$op}, bits => $bits{$op},
               arithmetic => $arithmetic{$op}, step => $step{$op}, and => $and{$op});
    for (sort keys %new) {
      add_change($b, $_, $at, length $op, $new{$_}) if defined $new{$_};
    }
    change_operand($b, $at) if $and{$op};
  }
}

# Leaves out the operator && or || at this place, and the operand after it.
sub change_operand {
  my ($b, $at) = @_;
  my $value = qr/!?[\w.>\[\]-]+/;
  my $operand = qr/$value$group?(?: (?:[<>]=?|[!=]=) -?[\w.>\[\]-]+)?/;
  add_change($b, 'part', $at, length $1, '')
    if substr($b->{code}, $at) =~ /^((?:&&|\|\|)\s+$operand)(?=\s*(?:&&|\|\||\)|;|\?))/;
}

sub change_signs {
  my ($b) = @_;
  while ($b->{code} =~ /( [-+] 1u?)(?=[;,)\] \n])/g) {
    add_change($b, 'one', $-[1], length $1, '');
  }
  while ($b->{code} =~ /(?:(?<=[(,=?:<>&|*+] )|(?<=[(\[])|(?<=return ))-(?=[\w(])/g) {
    add_change($b, 'sign', $-[0], 1, '');
  }
  while ($b->{code} =~ /(?<=[( ])!(?=[\w(*])/g) {
    add_change($b, 'not', $-[0], 1, '');
  }
}

sub change_conditions {
  my ($b) = @_;
  while ($b->{code} =~ /\b(if|while|for) \(/g) {
    my ($word, $at) = ($1, $+[0]);
    my $to = after_group(\$b->{code}, $at - 1) // next;
    my $length = $to - 1 - $at;
    pos($b->{code}) = $at;
    if ($word eq 'for') {
      add_change($b, 'last', $at + $-[1], length $1, "$1 + 1")
        if substr($b->{code}, $at, $length) =~ /;\s*(\w+)(?= < )/;
      next;
    }
    add_change($b, 'false', $at, $length, 'false');
    next if $word eq 'while'; # which would not end
    add_change($b, 'true', $at, $length, 'true');
    add_change($b, 'not', $at, $length, '!(' . substr($b->{text}, $at, $length) . ')');
  }
}

sub is_balanced { my ($t) = @_; $t =~ s/$group//g; return $t !~ /[()]/; }

sub change_choices {
  my ($b) = @_;
  while ($b->{code} =~ /(?<=[=(,][ ]|[(]|return[ ])([^=;{}?:,]+?)\s\?\s+([^;{}?:]+?)\s+:
                        \s+([^;{}?:,]+?)(?=;|,)/gx) {
    my ($at, $length, @part) = ($-[0], $+[0] - $-[0], "$1", "$2", "$3");
    my @new = map { substr($b->{text}, $-[$_], $+[$_] - $-[$_]) } 2, 3;
    next if grep { !is_balanced($_) } @part;
    add_change($b, 'choice', $at, $length, $_) for @new;
  }
}

# A statement without the conditions and loops before it, and where it begins.
sub bare_statement {
  my ($statement) = @_;
  my $from = 0;
  while (substr($statement, $from) =~ /^((?:\}?\s*else\s+)?(?:if|for|while) (?=\()|else\s+)/) {
    my $n = length $1;
    my $rest = substr($statement, $from + $n);
    if ($1 !~ /else\s+$/) {
      my $to = after_group(\$rest, 0) // last;
      $n += $to + (substr($rest, $to) =~ /^(\s*)/ ? length $1 : 0);
    }
    last if $from + $n >= length $statement;
    $from += $n;
  }
  return ($from, substr($statement, $from));
}

# Whether that can be left out: it is no declaration and returns nothing.
sub is_statement {
  my ($s) = @_;
  return 0 if $s =~ $declares || $s =~ /^(?:if|for|while|switch)\b/ || !is_balanced($s);
  return 1 if $s =~ /^(?:continue|break)$/;
  return 1 if $s =~ /^(?:\(void\))?[\w:.>-]+\s*(?:<[^()]*>)?\(.*\)$/s;          # a call
  return 1 if $s =~ /^(?:\+\+|--)[\w.>\[\]-]+$|^[\w.>\[\]-]+(?:\+\+|--)$/;
  return $s =~ /^\*?\(?[\w.>\[\]()&* +-]*?[\w\])]\s*(?:[-+*\/|&^%]|<<|>>)?=[^=]/s &&
         $s !~ /^\w+[*&]* [*&]*\w+\b/;                                     # an assignment
}

# What stands between two of ; { } or follows a condition.
sub change_statements {
  my ($b) = @_;
  (my $code = $b->{code}) =~
    s{\bfor $group}{my $loop = $&; $loop =~ tr/;/,/; $loop}ge;
  while ($code =~ /(?<=[;{}])\s*([^;{}]+)(?=;)/g) {
    my $at = $-[1];
    my ($from, $statement) = bare_statement($1);
    add_change($b, 'out', $at + $from, length $statement, '') if is_statement($statement);
  }
}

my $number = qr/0x[\da-f.]+(?:p[-+]?\d+)?|(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?/i;

# Another number instead of this one, with the same ending, as u or f.
sub other_number {
  my ($n, $ending) = @_;
  return $n eq '0' ? "1$ending" : $n eq '1' ? "0$ending"
       : $n =~ /^\d+$/ ? $n + 1 . $ending
       : $n =~ /^0x[\da-f]+$/i ? "($n$ending + 1)" : "(2 * $n$ending)";
}

sub change_numbers {
  my ($b) = @_;
  while ($b->{code} =~ /(?<![\w.])($number)([uf]?l*)(?![\w.])/gi) {
    my ($at, $length) = ($-[0], length "$1$2");
    add_change($b, 'constant', $at, $length, other_number("$1", "$2"));
  }
}

sub change_names {
  my ($b) = @_;
  while ($b->{code} =~ /(?<!\w)([A-Za-z_]\w*)(?!\w)/g) {
    add_change($b, 'name', $-[1], length $1, $opposite{$1}) if exists $opposite{$1};
  }
  while ($b->{code} =~ /(?<=\w\[)([a-z]\w*(?: [-+] \w+)?)(?=\])/gi) {
    add_change($b, 'index', $-[1], length $1, '0');
  }
}

sub change_arguments {
  my ($b) = @_;
  my $argument = qr/[^(),]+|[^(),]*\([^()]*\)/;
  while ($b->{code} =~ /\b([a-z_]\w*)\(($argument),(\s+)($argument)(?=[,)])/gi) {
    my ($name, $blank, $at, $length) = ($1, $3, $-[2], $+[4] - $-[2]);
    my ($first, $second) = map { substr($b->{text}, $-[$_], $+[$_] - $-[$_]) } 2, 4;
    next if $name =~ $control || $first eq $second;
    add_change($b, 'arguments', $at, $length, "$second,$blank$first");
  }
}

sub changes_of {
  my ($text, $masked, $begin, $end) = @_;
  my %b = (text => substr($$text, $begin, $end - $begin), changes => [],
           code => substr($$masked, $begin, $end - $begin));
  $_->(\%b) for \&change_operators, \&change_signs, \&change_conditions, \&change_choices,
                \&change_statements, \&change_numbers, \&change_names, \&change_arguments;
  my @sorted = sort { $a->[1] <=> $b->[1] || $a->[0] cmp $b->[0] } @{$b{changes}};
  return map { [$_->[0], $begin + $_->[1], $_->[2], $_->[3]] } @sorted;
}

# All mutants of a source. The number in a name counts those of the same kind in
# the same function, so that a name survives changes elsewhere.
sub mutants_of {
  my ($file, $text) = @_;
  my $masked = mask($text);
  my (@all, %n);
  for (bodies(\$masked)) {
    my ($function, $begin, $end) = @$_;
    for (changes_of(\$text, \$masked, $begin, $end)) {
      my ($kind, $at, $length, $new) = @$_;
      next if $new eq substr($text, $at, $length);
      my $number = ++$n{"$function:$kind"};
      push @all, {name => "$file:$function:$kind:$number", file => $file,
                  function => $function, kind => $kind,
                  at => $at, length => $length, new => $new};
    }
  }
  return @all;
}

sub change {
  my ($text, $m) = @_;
  substr($text, $m->{at}, $m->{length}) = $m->{new};
  return $text;
}

1;
