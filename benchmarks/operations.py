"""Floating point operations of a compiled function, counted in its source.

The source is gone through as it would run: integers, loops and calls of other compiled functions
are followed, everything else is only counted. An operation of a loop counts as often as the loop
runs, padding included. What a block writes twice counts once, as the compiler computes it once.
Loads, stores, indices and changes of sign count nothing; a division counts as one operation.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections import Counter
from dataclasses import dataclass
from functools import cache
from types import CodeType
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Operations:
    """Numbers of additions (subtractions among them), multiplications and divisions."""

    additions: float = 0
    multiplications: float = 0
    divisions: float = 0

    @property
    def total(self) -> float:
        """Of all kinds."""
        return self.additions + self.multiplications + self.divisions

    def __add__(self, other: Operations) -> Operations:
        return Operations(
            self.additions + other.additions,
            self.multiplications + other.multiplications,
            self.divisions + other.divisions,
        )

    def per(self, number: int) -> Operations:
        """Each over a number, of elements for example."""
        return Operations(
            self.additions / number, self.multiplications / number, self.divisions / number
        )


def operations(function, *arguments) -> dict[str, Operations]:
    """Operations of one call, by the function in whose body they stand.

    Parameters
    ----------
    function : compiled by `numba.njit`
        Assignments, loops over ranges and expressions; conditions cannot be counted.
    arguments
        As in the call; the integers and the shapes of the arrays decide the count.

    Raises
    ------
    NotImplementedError
        If its source has anything whose operations are not known.
    """
    counts = _Run().call(function, arguments)
    names = {name for name, _ in counts}
    return {
        name: Operations(*(counts[name, kind] for kind in (ast.Add, ast.Mult, ast.Div)))
        for name in sorted(names)
    }


_KINDS = {ast.Add: ast.Add, ast.Sub: ast.Add, ast.Mult: ast.Mult, ast.Div: ast.Div}


class _Run:
    """Counts of calls; those with the same integers and shapes are counted once."""

    def __init__(self):
        self._done: dict[tuple, Counter] = {}

    def call(self, function, arguments) -> Counter:
        key = (function, *map(_decisive, arguments))
        if key not in self._done:
            self._done[key] = _Body(function, arguments, self).counts
        return self._done[key]


def _decisive(argument) -> Any:
    """What of an argument decides the count."""
    return argument.shape if isinstance(argument, np.ndarray) else _integer(argument)


def _integer(value) -> int | None:
    whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
    return int(value) if whole else None


# What is asked of the same node in every pass of a loop.


@cache
def _definition(function) -> ast.FunctionDef:
    return ast.parse(textwrap.dedent(inspect.getsource(function.py_func))).body[0]


@cache
def _binary(target: ast.expr, op: ast.operator, value: ast.expr) -> ast.BinOp:
    return ast.BinOp(ast.parse(ast.unparse(target), mode="eval").body, op, value)


@cache
def _names(node: ast.expr) -> tuple[str, ...]:
    return tuple(each.id for each in ast.walk(node) if isinstance(each, ast.Name))


@cache
def _text(node: ast.expr) -> str:
    return ast.unparse(node)


@cache
def _code(node: ast.expr) -> CodeType:
    return compile(ast.fix_missing_locations(ast.Expression(node)), "<counted>", "eval")


class _Body:
    """One call of one function.

    `known` holds integers and arrays. Every other value is known by how it came about: constants,
    names with the time of their last assignment, and operations on these.
    """

    def __init__(self, function, arguments, run: _Run):
        plain, definition = function.py_func, _definition(function)
        self._name, self._globals, self._run = plain.__name__, plain.__globals__, run
        self._locals = set(plain.__code__.co_varnames)
        self._known: dict[str, Any] = {}
        self._assigned: dict[str, int] = {}
        self._clock = 0
        self._computed: set = set()
        self.counts: Counter = Counter()
        for parameter, argument in zip(definition.args.args, arguments, strict=True):
            self._assign(parameter.arg, argument)
        self._block(definition.body)

    def _block(self, statements) -> None:
        for statement in statements:
            self._statement(statement)

    def _statement(self, node: ast.stmt) -> None:
        match node:
            case ast.Assign(targets=targets, value=value):
                for target in targets:
                    self._bind(target, value)
            case ast.AugAssign(target=target, op=op, value=value):
                self._bind(target, _binary(target, op, value))
            case ast.For(target=ast.Name(id=name), iter=iterated, body=body, orelse=[]):
                self._loop(name, self._evaluated(iterated), body)
            case ast.If(
                test=ast.Compare(
                    left=ast.Name(id=name), ops=[ast.IsNot()], comparators=[ast.Constant(None)]
                ),
                body=body,
                orelse=[],
            ):  # what may be left out is an array
                if isinstance(self._known.get(name), np.ndarray):
                    self._block(body)
            case ast.Expr(value=value) | ast.Return(value=value):
                self._value(value)
            case _:
                raise self._unknown(node)

    def _bind(self, target: ast.expr, value: ast.expr) -> None:
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
            for one, its in zip(target.elts, value.elts, strict=True):
                self._bind(one, its)
            return
        self._value(value)
        match target:
            case ast.Name(id=name):
                self._assign(name, self._evaluated(value))
            case ast.Subscript(value=ast.Name(id=name)):
                self._touch(name)
            case _:
                raise self._unknown(target)

    def _assign(self, name: str, value) -> None:
        self._touch(name)
        whole = _integer(value)
        if whole is not None or isinstance(value, np.ndarray):
            self._known[name] = value if whole is None else whole
        else:
            self._known.pop(name, None)

    def _touch(self, name: str) -> None:
        self._clock += 1
        self._assigned[name] = self._clock

    def _loop(self, name: str, values, body) -> None:
        if not isinstance(values, range):
            raise NotImplementedError(f"{self._name}: a loop over {name} of unknown length")
        if any(self._varies(node) for statement in body for node in ast.walk(statement)):
            for value in values:
                self._assign(name, value)
                self._block(body)
        elif values:
            before = self.counts.copy()
            self._assign(name, values[0])
            self._block(body)
            once = self.counts - before
            self.counts.update({key: (len(values) - 1) * count for key, count in once.items()})

    def _varies(self, node: ast.AST) -> bool:
        """Whether what a node costs may differ from one pass of a loop to the next."""
        return isinstance(node, ast.For) or self._compiled(node) is not None

    def _compiled(self, node: ast.AST):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            function = self._globals.get(node.func.id)
            return function if hasattr(function, "py_func") else None
        return None

    def _value(self, node: ast.expr | None):
        """How a value came about, after counting what computes it."""
        whole = _integer(self._evaluated(node))
        if whole is not None:
            return whole
        match node:
            case None:
                return None
            case ast.Constant(value=value):
                return value
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return "minus", self._value(operand)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _KINDS:
                return self._operation(type(op), self._value(left), self._value(right))
            case ast.Call(args=arguments, keywords=[]):
                for argument in arguments:
                    self._value(argument)
                if (function := self._compiled(node)) is not None:
                    values = [self._evaluated(argument) for argument in arguments]
                    self.counts.update(self._run.call(function, values))
                self._clock += 1
                return "call", self._clock
            case ast.Name() | ast.Subscript() | ast.Attribute():
                return _text(node), *(self._assigned.get(name, 0) for name in _names(node))
        raise self._unknown(node)

    def _operation(self, op: type[ast.operator], left, right):
        if op in (ast.Add, ast.Mult):
            left, right = sorted((left, right), key=repr)
        result = op, left, right
        if result not in self._computed:
            self._computed.add(result)
            self.counts[self._name, _KINDS[op]] += 1
        return result

    def _evaluated(self, node: ast.expr | None):
        """Value of an expression of known integers and arrays, None of any other."""
        if node is None:
            return None
        if self._locals.intersection(_names(node)) - self._known.keys():
            return None
        if self._compiled(node) is not None:
            return None
        return eval(_code(node), self._globals, self._known)

    def _unknown(self, node: ast.AST) -> NotImplementedError:
        return NotImplementedError(f"{self._name}: cannot count '{ast.unparse(node)}'")
