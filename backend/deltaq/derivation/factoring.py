"""Factors of polynomials in many letters, by FLINT: SymPy's search for them may never end where letters are many.

Source: Geddes, Czapor, Labahn, Algorithms for Computer Algebra, §8.7.
"""

from __future__ import annotations

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly_ctx

Powers = list[tuple[sp.Expr, sp.Expr]]
HIGHEST = 300  # degree in one letter: of xⁿ − 1 with n a million FLINT's search takes gigabytes and hours


def factor_list(expression: sp.Expr) -> tuple[sp.Expr, Powers]:
    """A number c and irreducible factors with their powers, c·Π fᵢⁿⁱ = expression, in the letters and functions in it.

    A sum of a degree above HIGHEST in a letter is left as it is. Raises sp.PolynomialError for what is no polynomial.
    """
    number: sp.Expr = sp.Integer(1)
    found: dict[sp.Expr, sp.Expr] = {}
    for part in sp.Mul.make_args(expression):
        base, power = part.as_base_exp()
        if part.is_Number:
            number *= part
            continue
        if power.could_extract_minus_sign():
            raise sp.PolynomialError(f"a quotient: {sp.sstr(expression, order='lex')}")
        content, factors = _of_sum(base) if base.is_Add else (sp.Integer(1), [(base, sp.Integer(1))])
        number *= content**power
        for factor, times in factors:
            found[factor] = found.get(factor, 0) + times * power
    return number, list(found.items())


def _of_sum(expression: sp.Expr) -> tuple[sp.Expr, Powers]:
    """Factors of a lower degree in the first letter come first."""
    if _is_steep(expression):
        return sp.Integer(1), [(expression, sp.Integer(1))]
    poly = sp.Poly(expression)
    if not (poly.domain.is_ZZ or poly.domain.is_QQ):  # roots of numbers: few letters, which SymPy is made for
        return sp.factor_list(expression)  # type: ignore[no-any-return]
    if any(letter.as_base_exp()[1].could_extract_minus_sign() for letter in poly.gens):
        raise sp.PolynomialError(f"a quotient: {sp.sstr(expression, order='lex')}")
    letters = fmpq_mpoly_ctx.get([f"x{n}" for n in range(len(poly.gens))], Ordering.lex)
    number, factors = letters.from_dict({powers: _fraction(c) for powers, c in poly.as_dict().items()}).factor()
    rest, found = _rational(number), []
    for factor, power in factors:
        terms = {tuple(map(int, powers)): _rational(c) for powers, c in factor.to_dict().items()}
        content, primitive = sp.Poly(terms, *poly.gens, domain="QQ").primitive()
        rest *= sp.sympify(content) ** power
        found.append((primitive, sp.Integer(int(power))))
    found.sort(key=lambda one: (one[0].degree(), one[1], sorted(one[0].as_dict().items())))
    return rest, [(factor.as_expr(), power) for factor, power in found]


def _is_steep(expression: sp.Expr) -> bool:
    """Whether a power of a letter, or of one as exp(x/d) in exp(n x/d), is above HIGHEST."""
    exponents = (power.as_base_exp()[1] for power in expression.atoms(sp.Pow, sp.exp))
    numbers = (term.as_coeff_Mul()[0] for exponent in exponents for term in sp.Add.make_args(exponent))
    return any(abs(number.p) > HIGHEST for number in numbers if number.is_Rational)


def _fraction(number: sp.Expr) -> fmpq:
    return fmpq(int(number.p), int(number.q))


def _rational(number: fmpq) -> sp.Rational:
    return sp.Rational(int(number.p), int(number.q))
