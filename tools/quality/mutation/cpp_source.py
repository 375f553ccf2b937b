# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Reads C++ as far as tokens and functions, for mutate and for the proof table.

This is no parser.  It leans on the format of this repository, which a test
holds: clang-format writes a space on both sides of a binary operator and none
around `<` of a template, and a function's body opens with " {".
"""

import bisect
import hashlib
import re
from typing import NamedTuple

_TOKEN = re.compile(
    r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*)
  | (?P<string>(?:u8|[uUL])?R"(?P<raw>[^()\s]*)\(.*?\)(?P=raw)"
              |(?:u8|[uUL])?"(?:\\.|[^"\\\n])*")
  | (?P<char>'(?:\\.|[^'\\\n])+')
  | (?P<number>(?:\d|\.\d)(?:[eEpP][+-]|[\w.']|)*)
  | (?P<word>[^\W\d]\w*)
  | (?P<operator><<=|>>=|->\*|\.\.\.|::|->|\+\+|--|<<|<=|>=|==|!=|&&|\|\|
              |[-+*/%&|^]=|[-+*/%&|^~!<>=?:;,.(){}\[\]])
  | (?P<space>\s+)
  | (?P<other>.)
    """,
    re.VERBOSE | re.MULTILINE | re.DOTALL,
)

_OPENING = {"(": ")", "[": "]", "{": "}"}
_CLOSING = set(_OPENING.values())


class Token(NamedTuple):
    kind: str  # word, number, operator, string or char
    text: str
    start: int
    end: int
    before: bool  # Whether space comes before it,
    after: bool  # and after it.
    in_template: bool  # Whether it is one of a template's arguments.

    @property
    def is_binary(self):
        return self.before and self.after


class Function(NamedTuple):
    name: str  # As written before its parentheses: "Tree::Add", "Exp".
    scope: str  # The classes around it: "Tree" or "".
    is_local: bool  # Whether it stands in an anonymous namespace.
    is_public: bool  # Whether it stands in no private part of a class.
    first: int  # Its tokens, [first, last): the declaration, and from body
    body: int  # on what it does, initialisers too; == last in a mere declaration.
    last: int

    @property
    def qualified(self):
        return f"{self.scope}::{self.name}" if self.scope else self.name


def tokenize(text):
    """Returns the tokens of `text` without comments, directives and spaces."""
    raw = []
    depth = 0  # Of template brackets.
    for match in _TOKEN.finditer(text):
        kind = match.lastgroup if match.lastgroup != "raw" else "string"
        if kind in ("comment", "directive", "space", "other"):
            continue
        start, end, word = match.start(), match.end(), match.group()
        before = start == 0 or text[start - 1].isspace()
        after = end == len(text) or text[end].isspace()
        opens = (
            word == "<"
            and raw
            and (raw[-1].kind == "word" and not before or raw[-1].text == "template")
            and raw[-1].text != "operator"
        )
        in_template = depth > 0 or opens
        raw.append(Token(kind, word, start, end, before, after, in_template))
        if opens:
            depth += 1
        elif word == ">" and depth > 0:
            depth -= 1
        elif word in (";", "{"):
            depth = 0
    return raw


class Source:
    """One file: its text, its tokens, its functions."""

    def __init__(self, text):
        self.text = text
        self.tokens = tokenize(text)
        self.partner = self._match_brackets()
        self.functions = []
        self._classes = []  # (first token, last token, qualified name)
        self._find_functions()
        self._lines = [m.end() for m in re.finditer("\n", text)]

    def scope_of(self, i):
        """Returns the innermost class around token i, or ""."""
        around = [c for c in self._classes if c[0] < i < c[1]]
        return max(around)[2] if around else ""

    def line_number(self, offset):
        return bisect.bisect_right(self._lines, offset) + 1

    def line(self, offset):
        number = self.line_number(offset)
        return self.text.split("\n")[number - 1]

    def function_text(self, function):
        return self.text[
            self.tokens[function.first].start : self.tokens[function.last - 1].end
        ]

    def digest(self, function):
        """Returns a digest of a function that does not depend on its layout."""
        words = [t.text for t in self.tokens[function.first : function.last]]
        return hashlib.sha256(" ".join(words).encode()).hexdigest()[:12]

    def words(self, function):
        """Returns the identifiers of a function's body and initialisers."""
        return {
            t.text
            for t in self.tokens[function.first : function.last]
            if t.kind == "word"
        }

    def _match_brackets(self):
        partner, stack = {}, []
        self.around = []  # The innermost bracket that is open after each token.
        for i, token in enumerate(self.tokens):
            if token.kind == "operator" and token.text in _OPENING:
                stack.append(i)
            elif token.kind == "operator" and token.text in _CLOSING and stack:
                partner[stack[-1]] = i
                partner[i] = stack.pop()
            self.around.append(stack[-1] if stack else None)
        return partner

    def _find_functions(self):
        self._scan(0, len(self.tokens), [], False, True)

    def _scan(self, i, end, scope, is_local, is_public):
        """Collects the functions among tokens [i, end) of one scope."""
        tokens = self.tokens
        first = i  # Of the declaration that i is in.
        while i < end:
            token = tokens[i]
            if token.text in ("public", "private", "protected") and (
                i + 1 < end and tokens[i + 1].text == ":"
            ):
                is_public = token.text == "public"
                i += 2
                first = i
            elif token.text in ("(", "["):
                i = self.partner.get(i, end) + 1
            elif token.text == ";":
                self._declare(first, i, i + 1, scope, is_local, is_public)
                i += 1
                first = i
            elif token.text == "}":
                i += 1
                first = i
            elif token.text == "{":
                close = self.partner.get(i, end)
                words = [t.text for t in tokens[first:i]]
                if "namespace" in words:
                    local = is_local or words[-1] == "namespace"
                    self._scan(i + 1, close, scope, local, True)
                elif "enum" in words:
                    pass
                elif any(w in ("class", "struct", "union") for w in words) and (
                    "(" not in words
                ):
                    kind = next(w for w in words if w in ("class", "struct", "union"))
                    at = words.index(kind)
                    inner = scope + [words[at + 1]]
                    self._classes.append((i, close, "::".join(inner)))
                    self._scan(
                        i + 1, close, inner, is_local, is_public and kind != "class"
                    )
                elif not token.before or "=" in words and "(" not in words:
                    i = close + 1  # A braced initialiser; what follows belongs.
                    continue
                else:
                    self._declare(first, i, close + 1, scope, is_local, is_public)
                i = close + 1
                if i < end and tokens[i].text == ";":
                    i += 1
                first = i
            else:
                i += 1

    def _declare(self, first, body, last, scope, is_local, is_public):
        """Adds tokens [first, last) if they declare or define a function."""
        tokens = self.tokens
        # A macro before the function, such as an attribute with arguments.
        while tokens[first].text.isupper() and tokens[first + 1].text == "(" and (
            self.partner.get(first + 1, body) + 1 < body
        ):
            first = self.partner[first + 1] + 1
        i = first
        while i < body:
            text = tokens[i].text
            if text in ("using", "typedef", "friend", "static_assert", "="):
                if not (text == "=" and i > first and
                        tokens[i - 1].text == "operator"):
                    return
            if text == "[":
                i = self.partner.get(i, body)
            if text == "(" and not tokens[i].in_template:
                break
            i += 1
        if i >= body or i == first:
            return
        name = tokens[i - 1].text
        j = i - 1
        if tokens[j].kind != "word":  # operator*(...), operator()(...).
            while j > first and tokens[j].text != "operator":
                j -= 1
            name = "".join(t.text for t in tokens[j:i]) or "()"
            if name == "operator":
                name = "operator()"
        if name == "operator" and tokens[i + 1].text == ")":
            name = "operator()"
        while j > first and tokens[j - 1].text in ("~", "::"):
            if tokens[j - 1].text == "~":
                name, j = "~" + name, j - 1
            elif tokens[j - 2].kind == "word":
                name, j = f"{tokens[j - 2].text}::{name}", j - 2
            else:
                break
        # Neither a variable, `Vector3d v(1, 2, 3);`, nor a macro call is a function.
        if j == first and not scope and tokens[body].text == ";":
            return
        if tokens[body].text == ";":
            tail = [t.text for t in tokens[i:body]]
            if any(t in tail for t in ("default", "delete")):
                return
            if any(t.kind in ("number", "string") for t in tokens[i:body]) and (
                "=" not in tail
            ):
                return
        self.functions.append(
            Function(
                name,
                "::".join(scope),
                is_local,
                is_public,
                first,
                self.partner[i] + 1 if tokens[body].text == "{" else last,
                last,
            )
        )
