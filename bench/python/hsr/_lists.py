# SPDX-License-Identifier: GPL-3.0-or-later
"""What there is: scenes, kinds of answers, algorithms, options, counters."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from functools import cached_property, lru_cache
from typing import Any, Iterator, TypeVar

from ._errors import UsageError
from ._library import call, ffi, lib, string, struct, text

T = TypeVar("T")


# --- Structs as objects -------------------------------------------------------


def _convert(type_: str, value: Any) -> Any:
    if type_.startswith("str"):
        return text(value)
    return bool(value) if type_ == "bool" else value


def read(cls: type[T], info: Any, **more: Any) -> T:
    """An object whose members are those of a struct with the same names."""
    given = {
        f.name: _convert(str(f.type), getattr(info, f.name))
        for f in fields(cls)  # type: ignore[arg-type]
        if f.name not in more and f.init
    }
    return cls(**given, **more)


def _items(function: Any, name: str, *where: int) -> Iterator[Any]:
    """The structs of a list. It ends where the library has no such item."""
    k = 0
    while True:
        info = struct(name)
        try:
            call(function, *where, k, info)
        except UsageError:
            return
        yield info
        k += 1


# --- Scenes and kinds of answers ----------------------------------------------


@dataclass(frozen=True)
class Builtin:
    """A built-in scene. hsr.scene opens it by its name or by the words of
    `usage`.

    name      "soup"
    usage     "soup:N:SEED"
    about     a sentence
    package   the Debian package that it needs
    is_there  False if that package is not installed
    """

    name: str
    usage: str
    about: str
    package: str | None
    is_there: bool

    def __repr__(self) -> str:
        return f"<hsr.Builtin {self.usage}: {self.about}>"


@dataclass(frozen=True)
class Kind:
    """A kind of answer.

    name         "ids"
    meaning      "the visible face of every sample"
    places       "samples": what the judge compares
    has_windows  windows of it can be drawn, also by several threads
    """

    name: str
    meaning: str
    places: str
    has_windows: bool

    def __repr__(self) -> str:
        return f"<hsr.Kind {self.name}: {self.meaning}>"


@lru_cache(maxsize=None)
def kinds() -> tuple[Kind, ...]:
    """All kinds of answers."""
    return tuple(
        read(Kind, info) for info in _items(lib.hsr_get_kind, "hsr_kind_info")
    )


def scenes() -> tuple[Builtin, ...]:
    """All built-in scenes."""
    return tuple(
        read(Builtin, info)
        for info in _items(lib.hsr_get_builtin, "hsr_builtin_info")
    )


# --- Options and counters -----------------------------------------------------


@dataclass(frozen=True)
class Word:
    """A word that an option may have as its value.

    name     "faces"
    meaning  "scan-converted, as in 1993"
    """

    name: str
    meaning: str


@dataclass(frozen=True)
class Option:
    """An option of an algorithm. It is chosen in the text of a request, as
    "watkins:x-list=tree".

    name      "x-list"
    meaning   a clause
    kind      the kind of answer that has it
    is_real   the number is real, not whole
    least     of a number, included
    most      of a number, included
    standard  the number, or that of a word, from 0; -1: none is standard
    words     the words for its value; none: a number
    """

    name: str
    meaning: str
    kind: str | None
    is_real: bool
    least: float
    most: float
    standard: float
    words: tuple[Word, ...] = ()

    def __repr__(self) -> str:
        words = "|".join(w.name for w in self.words)
        values = words or f"{self.least:g} to {self.most:g}"
        return f"<hsr.Option {self.name}={values}: {self.meaning}>"


@dataclass(frozen=True)
class Counter:
    """A counter of an algorithm. Counters of different algorithms that count the
    same thing have the same name.

    name         "X merge"
    key          a stable word, "cube-visited"
    meaning      a clause
    step         the kind of step: "sort", "compare", "span" ...
    a            the kind of the first subject of its steps
    b            the kind of the second
    outcomes     of a step, from 0: "farther|nearer"
    is_computed  steps are not performed, but their number is computed
    line         of the algorithm's outline, from 1; 0: none
    line_text    that line, in the paper's words
    """

    name: str
    key: str | None
    meaning: str
    step: str
    a: str
    b: str
    outcomes: str | None
    is_computed: bool
    line: int
    line_text: str | None

    def __repr__(self) -> str:
        return f"<hsr.Counter {self.name}: {self.meaning}>"


def _option(algorithm: int, k: int, info: Any) -> Option:
    words = _items(lib.hsr_get_word, "hsr_word_info", algorithm, k)
    return read(Option, info, words=tuple(read(Word, word) for word in words))


# --- Algorithms ---------------------------------------------------------------


@dataclass(frozen=True)
class Algorithm:
    """An algorithm. The oracles define what is right.

    name            "watkins"
    title           "Watkins' scan-line algorithm"
    authors         "G. S. Watkins"
    year            of publication; 0: never published
    source          where it is published and described
    class_name      in figure 13 of the survey: "image space"
    branch          "point sampling"
    sort_order      "YXZ"
    coherence       what it bets on
    restrictions    codes of figure 29, "CF TR"; scenes are adapted
    kind            the name of its own kind of answer
    kinds           the names of those that it can be asked for
    is_oracle       it defines what is right
    draws_nothing   it is a yardstick, and is not judged
    is_known_wrong  its answer is wrong sometimes, as published
    number          in the library's list, from 0
    """

    name: str
    title: str
    authors: str
    year: int
    source: str
    class_name: str
    branch: str | None
    sort_order: str | None
    coherence: str | None
    restrictions: str
    kind: str
    kinds: tuple[str, ...]
    is_oracle: bool
    draws_nothing: bool
    is_known_wrong: bool
    number: int = field(repr=False)

    @cached_property
    def options(self) -> tuple[Option, ...]:
        """The options that may be chosen."""
        infos = _items(lib.hsr_get_option, "hsr_option_info", self.number)
        return tuple(_option(self.number, k, info) for k, info in enumerate(infos))

    @cached_property
    def counters(self) -> tuple[Counter, ...]:
        """What it counts, in the order of Answer.count."""
        infos = _items(lib.hsr_get_counter, "hsr_counter_info", self.number)
        return tuple(read(Counter, info) for info in infos)

    def __repr__(self) -> str:
        year = f", {self.year}" if self.year else ""
        return f"<hsr.Algorithm {self.name}: {self.title}{year}>"


def _algorithm(number: int, info: Any) -> Algorithm:
    names = [kind.name for kind in kinds()]
    possible = tuple(n for k, n in enumerate(names) if info.kinds >> k & 1)
    return read(
        Algorithm, info, number=number, kind=names[info.kind], kinds=possible
    )


@lru_cache(maxsize=None)
def algorithms() -> tuple[Algorithm, ...]:
    """All algorithms. The oracles come first."""
    infos = _items(lib.hsr_get_algorithm, "hsr_algorithm_info")
    return tuple(_algorithm(number, info) for number, info in enumerate(infos))


def algorithm(name: str) -> Algorithm:
    """The algorithm with this name. UsageError if there is none; it names one
    that is like it."""
    number = ffi.new("size_t *")
    call(lib.hsr_find_algorithm, string("name", name), number)
    return algorithms()[number[0]]
