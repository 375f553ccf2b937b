# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Makes the mutants of a C++ file: small errors that a test should detect."""

import collections
import hashlib
from typing import NamedTuple

from cpp_source import Source, tokenize
from expressions import Digester

_ARITHMETIC = {
    "+": "-", "-": "+", "*": "/", "/": "*", "%": "*",
    "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=",
}
_COMPARISON = {
    "<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"),
    "==": ("!=",), "!=": ("==",),
}
_LOGIC = {"&&": "||", "||": "&&"}
_WORDS = {
    "min": "max", "max": "min", "true": "false", "false": "true",
    "sin": "cos", "cos": "sin", "head": "tail", "tail": "head",
    "row": "col", "col": "row", "rows": "cols", "cols": "rows",
    "topRows": "bottomRows", "bottomRows": "topRows",
    "leftCols": "rightCols", "rightCols": "leftCols",
    "x": "y", "y": "z", "z": "x", "w": "x",
    "break": "continue", "continue": "break",
    "lower": "upper", "upper": "lower",
}
_ACCESSORS = {"x", "y", "z", "w", "lower", "upper"}  # Mutated as calls only.
_SYMMETRIC = {"min", "max", "swap", "hypot", "Max", "Min"}
# Calls whose arguments are checks and messages, not results.
_CHECKS = {"assert", "static_assert", "throw"}
_ENDS_A_TERM = {
    "+", "-", ";", ",", ")", "]", "}", "?", ":", "<<", "<", ">", "<=", ">=", "==",
    "!=", "&&", "||",
}
_NO_STATEMENT = {
    "return", "if", "else", "for", "while", "do", "switch", "case", "default",
    "using", "break", "continue", "const", "auto", "static", "constexpr", "{",
    "}", ";", "delete", "goto", "try", "catch",
} | _CHECKS
# Lets a mutant compile that leaves a variable unused. The pragma is on the licence's
# line, so that no other line moves.
_QUIET = " ".join(
    f'_Pragma("GCC diagnostic ignored \\"-W{warning}\\"")'
    for warning in (
        "unused-variable", "unused-parameter", "unused-but-set-variable",
        "unused-but-set-parameter", "unused-function", "unused-value",
        "conversion", "float-conversion", "sign-compare", "type-limits",
        "parentheses", "logical-op", "bool-compare", "bool-operation",
        "int-in-bool-context", "div-by-zero", "array-bounds", "empty-body",
        "tautological-compare", "return-type", "nonnull", "stringop-overflow",
    )
)


class Mutant(NamedTuple):
    path: str
    function: str  # Qualified; "" outside of functions.
    kind: str
    start: int  # text[start:end] becomes `new`.
    end: int
    new: str
    line: int
    before: str  # The line, as it was and as it became.
    after: str
    id: str  # The same as long as the function's text is.
    place: str  # The function, or "(constants)".
    digest: str  # Of the expression and the change, with local names numbered.

    @property
    def key(self):
        """Returns the name of the mutant in the ledger, independent of its file."""
        return self.place, self.digest

    @property
    def layer(self):
        return self.path.split("/")[0]

    def describe(self):
        where = f"{self.path}:{self.line} in {self.place}, {self.digest}"
        return f"{where} ({self.kind})\n  - {self.before}\n  + {self.after}"


def apply(mutant, text):
    """Returns the file with the mutation; every line keeps its number."""
    changed = text[: mutant.start] + mutant.new + text[mutant.end :]
    gone = text[mutant.start : mutant.end].count("\n") - mutant.new.count("\n")
    if gone:
        end = mutant.start + len(mutant.new)
        changed = changed[:end] + "\n" * gone + changed[end:]
    first, rest = changed.split("\n", 1)
    return (_QUIET if first.startswith("//") else first) + "\n" + rest


def make_mutants(path, text):
    """Returns every mutant of a file in the order of its text."""
    return _Maker(path, Source(text)).make()


class _Maker:
    def __init__(self, path, source):
        self.path = path
        self.source = source
        self.tokens = source.tokens
        self.found = []  # (first token, last token, new, kind)
        self.digester = None  # Of the function whose mutants are made.
        self.ordinals = collections.Counter()

    def make(self):
        mutants = []
        inside = set()
        for function in self.source.functions:
            self.found = []
            self.digester = Digester(self.source, function)
            self._mutate_range(function.body, function.last)
            inside.update(range(function.first, function.last))
            if function.body == function.last or not self.found:
                continue
            origin = self.tokens[function.first].start
            mutants += self._name(function.qualified, self.source.digest(function))
        self.found = []
        self.digester = Digester(self.source)
        self._mutate_constants_outside(inside)
        mutants += self._name("", "")
        return sorted(mutants, key=lambda m: (m.start, m.end))

    def _name(self, function, digest):
        text = self.source.text
        seen = {}
        for first, last, new, kind in self.found:
            start, end = self.tokens[first].start, self.tokens[last].end
            head = text.rfind("\n", 0, start) + 1
            tail = text.find("\n", start)
            before = text[head:tail].strip()
            changed = text[head:start] + new + text[end : max(tail, end)]
            after = changed.split("\n")[0].strip()
            # Equal mutants are numbered in the order of tokens, so that a comment
            # or a new line does not matter.
            key = (before, after, new)
            seen[key] = seen.get(key, 0) + 1
            parts = (self.path, function, digest, before, after, new, str(seen[key]))
            place = function or "(constants)"
            yield Mutant(
                self.path, function, kind, start, end, new,
                self.source.line_number(start), before, after,
                hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16],
                place, self._digest(place, first, last, new),
            )

    def _digest(self, place, first, last, new):
        """Returns a digest; equal expressions of a function get "...", "....2"."""
        words = [t.text for t in tokenize(new)]
        digest = self.digester.of_mutant(first, last, words)
        self.ordinals[place, digest] += 1
        ordinal = self.ordinals[place, digest]
        return digest if ordinal == 1 else f"{digest}.{ordinal}"

    def _add(self, first, last, new, kind):
        """Adds the mutant in which tokens [first, last] become `new`."""
        start, end = self.tokens[first].start, self.tokens[last].end
        if self.source.text[start:end] != new:
            self.found.append((first, last, new, kind))

    def _mutate_range(self, first, last):
        i = first
        while i < last:
            token = self.tokens[i]
            if token.text in _CHECKS:
                i = self._end_of_statement(i, last) + 1
                continue
            if token.text == "using":
                i = self._end_of_statement(i, last) + 1
                continue
            if not token.in_template:
                self._mutate_token(i, last)
            i += 1

    def _end_of_statement(self, i, last):
        while i < last and self.tokens[i].text != ";":
            if self.tokens[i].text in ("(", "[", "{"):
                i = self.source.partner.get(i, last)
            i += 1
        return i

    def _mutate_token(self, i, last):
        tokens = self.tokens
        token, text = tokens[i], tokens[i].text
        previous = tokens[i - 1]
        if text in _ARITHMETIC and token.is_binary:
            if "string" in (previous.kind, tokens[i + 1].kind):
                return
            self._add(i, i, _ARITHMETIC[text], "operator")
            if text in ("+", "-"):
                self._remove_term(i, last)
        elif text == "-" and not token.after:
            self._add(i, i, "", "sign")
        elif text in _COMPARISON and token.is_binary:
            for new in _COMPARISON[text]:
                self._add(i, i, new, "comparison")
        elif text in _LOGIC and token.is_binary:
            self._add(i, i, _LOGIC[text], "logic")
        elif text == "!":
            self._add(i, i, "", "logic")
        elif text == "++":
            self._add(i, i, "--", "operator")
        elif text == "--":
            self._add(i, i, "++", "operator")
        elif token.kind == "number":
            for new in _other_numbers(text):
                kind = "index" if previous.text in ("[", "(") else "constant"
                self._add(i, i, new, kind)
        elif token.kind == "word":
            self._mutate_word(i)
        elif text == "[":
            self._shift_index(i)
        elif text == "(":
            self._swap_arguments(i)
        if text in (";", "{", "}", ")"):
            self._remove_statement(i, last)
        if text == "return":
            self._negate(i, last)

    def _mutate_word(self, i):
        text = self.tokens[i].text
        if text == "transpose" and self.tokens[i - 1].text == ".":
            self._add(i - 1, i + 2, "", "operator")
        if text not in _WORDS or self.digester.is_local(i):
            return
        following = self.tokens[i + 1].text
        if text in _ACCESSORS and not (
            self.tokens[i - 1].text in (".", "->") and following == "("
        ):
            return
        self._add(i, i, _WORDS[text], "word")

    def _shift_index(self, i):
        if (
            self.tokens[i - 1].kind == "word"
            and self.tokens[i + 1].kind == "word"
            and self.tokens[i + 2].text == "]"
        ):
            self._add(i + 1, i + 1, self.tokens[i + 1].text + " + 1", "index")

    def _swap_arguments(self, i):
        if self.tokens[i - 1].kind != "word" or (
            self.tokens[i - 1].text in _SYMMETRIC
        ):
            return
        close = self.source.partner.get(i)
        if close is None:
            return
        commas, j = [], i + 1
        while j < close:
            if self.tokens[j].text in ("(", "[", "{"):
                j = self.source.partner.get(j, close)
            elif self.tokens[j].text == "," and not self.tokens[j].in_template:
                commas.append(j)
            j += 1
        if not 1 <= len(commas) <= 2:
            return
        end = commas[1] if len(commas) == 2 else close
        one, two = (i + 1, commas[0] - 1), (commas[0] + 1, end - 1)
        a, b = self._text(*one), self._text(*two)
        if a == b or not (self._is_simple(*one) and self._is_simple(*two)):
            return
        self._add(one[0], two[1], f"{b}, {a}", "arguments")

    def _is_simple(self, first, last):
        """Returns whether the tokens are one value: a name, a member, a number."""
        if last - first > 4 or last < first:
            return False
        words = self.tokens[first : last + 1]
        if not all(
            t.kind in ("word", "number") or t.text in (".", "->", "::", "-")
            for t in words
        ):
            return False
        return not any(
            a.kind == "word" and b.kind == "word" for a, b in zip(words, words[1:])
        )

    def _text(self, first, last):
        return self.source.text[self.tokens[first].start : self.tokens[last].end]

    def _remove_term(self, i, last):
        """Removes a term: b c of a + b c - d."""
        j = i + 1
        while j < last and not (
            self.tokens[j].text in _ENDS_A_TERM
            and (self.tokens[j].is_binary or self.tokens[j].text in ";,)]}:")
        ):
            if self.tokens[j].text in ("(", "[", "{"):
                j = self.source.partner.get(j, last)
            j += 1
        if j > i + 1:
            # Starts at the operator, because "a +b" would be read differently.
            self._add(i, j - 1, "", "term")

    def _remove_statement(self, i, last):
        """Removes the statement after token i, unless it is a declaration."""
        first = i + 1
        if first >= last or self.tokens[first].text in _NO_STATEMENT:
            return
        if self.tokens[i].text == "{" and not self.tokens[i].after:
            return  # Of a braced initialiser.
        if self.tokens[i].text == ")":
            opening = self.source.partner.get(i, 0)
            if self.tokens[opening - 1].text not in ("if", "for", "while"):
                return
        if self.tokens[first].kind != "word" and self.tokens[first].text not in (
            "*", "++", "--",
        ):
            return
        end = self._end_of_statement(first, last)
        around = self.source.partner.get(self.source.around[i], last)
        if end >= last or end > around:  # The last part of a loop's head.
            return
        j, acts = first, False
        while j < end:
            token = self.tokens[j]
            if token.text in ("(", "="):
                acts = True
                break
            if token.text in _ARITHMETIC or token.text in ("<<", "++", "--"):
                acts = True
                if token.is_binary or token.text in ("++", "--"):
                    break
            if token.text == "[":
                j = self.source.partner.get(j, end)
            elif token.kind == "word" and self.tokens[j + 1].kind == "word":
                return  # A type and a name.
            elif token.text in ("*", "&") and not token.before and (
                self.tokens[j + 1].kind == "word"
            ):
                return
            elif token.text == ">" and token.in_template and (
                self.tokens[j + 1].kind == "word"
            ):
                return
            elif token.text == "{":
                return
            j += 1
        if acts:
            self._add(first, end, ";", "statement")

    def _negate(self, i, last):
        """return a;  ->  return -(a);"""
        end = self._end_of_statement(i, last)
        words = self.tokens[i + 1 : end]
        if not words or words[0].text in ("{", "-", "!"):
            return
        plain = all(
            t.text not in _LOGIC and t.kind not in ("string", "char")
            and not (t.text in _COMPARISON and t.is_binary)
            and t.text not in ("true", "false", "nullptr", "=", "?", "this")
            for t in words
        )
        if plain and not (len(words) == 1 and words[0].kind == "number"):
            self._add(i + 1, end - 1, f"-({self._text(i + 1, end - 1)})", "sign")

    def _mutate_constants_outside(self, inside):
        """Mutates constants and default values outside of functions."""
        after_equals = False
        for i, token in enumerate(self.tokens):
            if i in inside:
                after_equals = False
                continue
            if token.text == "=":
                after_equals = self.tokens[i - 1].text != ")"
            elif token.text in (";", ",", "enum"):
                after_equals = False
            elif after_equals and not token.in_template:
                if token.kind == "number":
                    for new in _other_numbers(token.text):
                        self._add(i, i, new, "constant")
                elif token.text in ("true", "false"):
                    self._add(i, i, _WORDS[token.text], "constant")
                elif token.text in _ARITHMETIC and token.is_binary:
                    self._add(i, i, _ARITHMETIC[token.text], "operator")


def _other_numbers(text):
    """Returns plausible wrong values of a number."""
    if text.lower().startswith("0x") or not text[-1].isdigit() and text[-1] != ".":
        return []
    if text.isdigit():
        value = int(text)
        return [str(value + 1)] + ([str(value - 1)] if value > 0 else [])
    value = float(text)
    if value == 0:
        return ["1.0"]
    if "e" in text.lower():
        mantissa, exponent = text.lower().split("e")
        return [f"{mantissa}e{int(exponent) + 1}", f"{mantissa}e{int(exponent) - 1}"]
    return [repr(value + 1) if value >= 1 else repr(2 * value)]
