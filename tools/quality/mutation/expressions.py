# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Digests of expressions in which local names are numbered.

A digest stays the same when a local name changes, a comment moves, the layout
changes, or the function moves to another file.  Local names are the parameters
of a function and of its lambdas, and the variables declared in the function.
Members, types and called functions keep their names.
"""

import bisect
import hashlib

_BEFORE_NO_NAME = {
    "return", "else", "new", "delete", "throw", "case", "goto", "using",
    "typename", "class", "struct", "enum", "union", "namespace", "operator",
    "template", "sizeof", "do", "co_return", "typedef",
}
_NO_NAME = {
    "const", "constexpr", "static", "volatile", "auto", "int", "double", "float",
    "bool", "char", "long", "short", "unsigned", "signed", "void", "noexcept",
    "override", "final", "this", "mutable",
}
_AFTER_NAME = {"=", ";", ",", ")", "(", "{", "[", ":"}
_CONTROL = {"if", "for", "while", "switch"}
_LABELS = {"public", "private", "protected", "default"}


class Locals:
    """Local names of one function, resolved to their declarations."""

    def __init__(self, source, function):
        self._tokens = source.tokens
        self._partner = source.partner
        self._declared = {}  # Name: tokens that declare it, in order.
        first = self._parameters(function)
        self._find_declarations(first, function.last)

    def resolve(self, name, i):
        """Returns the token that declares `name` for token i; None if not local."""
        if self._tokens[i].text == name and i > 0 and (
            self._tokens[i - 1].text in (".", "->", "::")
        ):
            return None
        places = self._declared.get(name, ())
        at = bisect.bisect_right(places, i)
        return places[at - 1] if at else None

    def _parameters(self, function):
        if self._tokens[function.body - 1].text == ")":
            return self._partner.get(function.body - 1, function.first)
        return function.first

    def _find_declarations(self, first, last):
        tokens = self._tokens
        for i in range(first + 1, last - 1):
            if tokens[i].text == "[" and self._follows_auto(i):
                for j in range(i + 1, self._partner.get(i, i)):
                    if tokens[j].kind == "word":
                        self._declare(j)
            elif self._is_declared(i):
                self._declare(i)
                self._declare_others(i, last)

    def _declare(self, i):
        places = self._declared.setdefault(self._tokens[i].text, [])
        if i not in places:
            bisect.insort(places, i)

    def _follows_auto(self, i):
        """Returns whether a structured binding begins here: `auto& [a, b]`."""
        before = self._tokens[i - 1].text
        return before == "auto" or before in ("&", "&&") and (
            self._tokens[i - 2].text == "auto"
        )

    def _is_declared(self, i):
        """Returns whether a type precedes the name at token i."""
        token, before = self._tokens[i], self._tokens[i - 1]
        if token.kind != "word" or token.text in _NO_NAME or (
            self._tokens[i + 1].text not in _AFTER_NAME
        ):
            return False
        if before.kind == "word":
            return before.text not in _BEFORE_NO_NAME
        if before.text in ("*", "&", "&&"):
            if before.before and not before.after:  # `double *a = p, *b = q;`
                type_name = self._tokens[i - 2]
                return type_name.kind == "word" and (
                    type_name.text not in _BEFORE_NO_NAME
                )
            return before.after and not before.before
        return before.text == ">" and before.in_template and before.after

    def _declare_others(self, i, last):
        """Declares b of `int a = 0, b = 1;`."""
        if not self._is_in_statement(i):
            return
        j = i + 1
        while j < last and self._tokens[j].text not in (";", ")", ":", "}"):
            text = self._tokens[j].text
            if text in ("(", "[", "{"):
                j = self._partner.get(j, last)
            elif text == ",":
                while self._tokens[j + 1].text in ("*", "&"):
                    j += 1
                if self._tokens[j + 1].kind == "word":
                    self._declare(j + 1)
            j += 1

    def _is_in_statement(self, i):
        """Returns whether token i is in a block or in the head of a loop."""
        j = i - 1
        while j >= 0 and self._tokens[j].text not in (";", "{", "}"):
            if self._tokens[j].text == "(":
                return self._tokens[j - 1].text in _CONTROL
            if self._tokens[j].text in (")", "]"):
                j = self._partner.get(j, 0)
            j -= 1
        return True


class Digester:
    """Digests of the expressions inside or outside of functions."""

    def __init__(self, source, function=None):
        self._source = source
        self._locals = Locals(source, function) if function else None
        self._begin = function.body if function else 0
        self._end = function.last if function else len(source.tokens)

    def is_local(self, i):
        """Returns whether token i is a local name."""
        return isinstance(self._resolve(self._source.tokens[i].text, i), int)

    def of_mutant(self, first, last, new):
        """The digest of an expression whose tokens [first, last] become `new`,
        which is a list of words."""
        begin, end = self._expression(first, last)
        words = [
            ("", "" if self._locals else self._source.scope_of(first)),
            *self._words(range(begin, first)), ("", "<<<"),
            *self._words(range(first, last + 1)), ("", ">>>"),
            *((self._resolve(word, first), word) for word in new), ("", "<<<"),
            *self._words(range(last + 1, end)),
        ]
        return hash_words(self._number(words))

    def _expression(self, first, last):
        """The tokens [begin, end) of the expression that [first, last] stand in:
        between semicolons, braces, labels, and the parentheses of a statement."""
        begin, end = first, last + 1
        while begin > self._begin and not self._separates(begin - 1):
            begin -= 1
        if not self._separates(last):
            while end < self._end and not self._separates(end):
                end += 1
        return begin, end

    def _separates(self, i):
        tokens, text = self._source.tokens, self._source.tokens[i].text
        if text in ("(", ")"):
            opening = i if text == "(" else self._source.partner.get(i, 0)
            return tokens[opening - 1].text in _CONTROL
        return text in (";", "{", "}") or text == ":" and (
            tokens[i - 1].text in _LABELS
        )

    def _resolve(self, name, i):
        return self._locals.resolve(name, i) if self._locals else None

    def _words(self, indices):
        tokens = self._source.tokens
        return [(self._resolve(tokens[i].text, i), tokens[i].text) for i in indices]

    @staticmethod
    def _number(words):
        """Replaces local names by numbers in the order of declaration."""
        declared = sorted({place for place, _ in words if isinstance(place, int)})
        numbers = {place: f"${n}" for n, place in enumerate(declared)}
        return [numbers.get(place, text) for place, text in words]


def hash_words(words):
    return hashlib.sha256(" ".join(words).encode()).hexdigest()[:12]
