"""Sine and cosine of the same numbers at once, lane by lane the same digits however many lanes there are.

Each is within one unit in the last place. A number x is n π/2 + r with |r| ≤ π/4; π/2 is subtracted in three parts by
fused operations, of which the first is exact and the second keeps its rest, so that r has all its digits also next to a
multiple of π/2 (Cody, Waite, Software Manual for the Elementary Functions, ch. 8). Then come Taylor's series of r, as
long as they have a say. Where |x| is very large the C library is asked.
"""

from __future__ import annotations

from math import factorial, pi

from .code import LIBRARY, Code, MachineCode, compiled, host, shared

LARGEST = 2.0**30  # beyond, three parts of π/2 may be too few
PARTS = (pi / 2.0, 6.123233995736766e-17, -1.4973849048591698e-33)  # of π/2, each what is left of it, rounded
TURNS = 2.0 / pi
WHOLE = 1.5 * 2.0**52  # added to a number it leaves the whole part in the last bits
OF_SINE = [(-1.0) ** k / factorial(2 * k + 1) for k in range(1, 9)]
OF_COSINE = [(-1.0) ** k / factorial(2 * k) for k in range(2, 9)]


def sine_and_cosine(code: Code, x: str) -> tuple[str, str]:
    """sin x and cos x, made once for each x."""
    if not host().has_fma:
        return code.function("sin", x), code.function("cos", x)
    if x not in code.circular:
        name = f"circular.{code.lanes}"
        shared(name, lambda: _made(name, code.lanes))
        code.declared.add(f'declare {_pair(code)} @"{LIBRARY}{name}"({code.kind})')
        both = code.new(f'call {_pair(code)} @"{LIBRARY}{name}"({code.kind} {x})')
        sine, cosine = (code.new(f"extractvalue {_pair(code)} {both}, {number}") for number in (0, 1))
        code.circular[x] = (sine, cosine)
    return code.circular[x]


def _pair(code: Code) -> str:
    return f"{{ {code.kind}, {code.kind} }}"


def _made(name: str, lanes: int) -> MachineCode:
    """The function of one argument that returns a pair: a fifth of the code of a small model, and the same for all."""
    code = Code(lanes)
    kind, pair = code.kind, _pair(code)
    code.label("entry")
    number, r, rest = _reduced(code, "%x")
    near = _turned(code, number, *_near_zero(code, r, rest))
    is_far = code.new(f"fcmp ugt {kind} {code.size('%x')}, {code.number(LARGEST)}")
    code.do(f"br i1 {_any(code, is_far)}, label %far, label %end")
    code.label("far")
    far = [code.select(is_far, code.function(name, "%x"), one) for name, one in zip(("sin", "cos"), near, strict=True)]
    code.do("br label %end")
    code.label("end")
    ends = zip(near, far, strict=True)
    sine, cosine = (code.new(f"phi {kind} [ {one}, %entry ], [ {other}, %far ]") for one, other in ends)
    half = code.new(f"insertvalue {pair} poison, {kind} {sine}, 0")
    whole = code.new(f"insertvalue {pair} {half}, {kind} {cosine}, 1")
    code.do(f"ret {pair} {whole}")
    return compiled({name: code}, pair, f"{kind} %x")


def _any(code: Code, truths: str) -> str:
    """Whether anything holds in any lane."""
    if code.lanes == 1:
        return truths
    bits = code.new(f"bitcast <{code.lanes} x i1> {truths} to i{code.lanes}")
    return code.new(f"icmp ne i{code.lanes} {bits}, 0")


def _reduced(code: Code, x: str) -> tuple[str, str, str]:
    """A number that ends with n, and r with what rounding leaves of it."""
    shifted = code.multiply_add(x, code.number(TURNS), code.number(WHOLE))
    n = code.subtract(shifted, code.number(WHOLE))
    less = code.negative(n)
    exact = code.multiply_add(less, code.number(PARTS[0]), x)
    second = code.multiply(less, code.number(PARTS[1]))
    lost = code.multiply_add(less, code.number(PARTS[1]), code.negative(second))
    r = code.add(exact, second)
    mine = code.subtract(r, second)  # both rests of the sum (Knuth)
    rest = code.add(code.subtract(exact, mine), code.subtract(second, code.subtract(r, mine)))
    return shifted, r, code.add(rest, code.multiply_add(less, code.number(PARTS[2]), lost))


def _near_zero(code: Code, r: str, rest: str) -> tuple[str, str]:
    """sin(r + rest) and cos(r + rest) for |r| ≤ π/4."""
    one, square = code.number(1.0), code.multiply(r, r)
    half = code.multiply(code.number(0.5), square)
    most = code.subtract(one, half)
    of_sine = code.multiply_add(code.multiply(r, square), code.horner(OF_SINE, square), code.multiply(rest, most))
    below = code.subtract(code.subtract(one, most), half)
    of_cosine = code.multiply_add(
        code.multiply(square, square), code.horner(OF_COSINE, square), code.multiply(code.negative(r), rest)
    )
    return code.add(r, of_sine), code.add(most, code.add(below, of_cosine))


def _turned(code: Code, number: str, sine: str, cosine: str) -> tuple[str, str]:
    """Those of r + n π/2, where the number ends with n."""
    bits = code.bits(number)
    is_odd = code.new(f"icmp ne {code.whole} {code.on_bits('and', bits, 1)}, {code.integer(0)}")
    pair = code.select(is_odd, cosine, sine), code.select(is_odd, sine, cosine)
    found = []
    for value, turns in zip(pair, (bits, code.on_bits("add", bits, 1)), strict=True):
        sign = code.on_bits("shl", code.on_bits("and", turns, 2), 62)
        found.append(code.of_bits(code.on_bits("xor", code.bits(value), sign)))
    return found[0], found[1]
