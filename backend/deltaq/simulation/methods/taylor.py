"""Taylor: the series of the motion itself, by recurrences made of the model; for high accuracy and long times.

Order p by the tolerance: with the local tolerance ε that which takes least time, p = 1 − ⅔ ln ε, so 23 for 10⁻¹⁴; with
a step that is given p = 8. No stages, and no tableau: all coefficients are found one after the other, and an order
counts as one evaluation of the right-hand side. The last two coefficients choose the step, the series itself gives all
samples and events. Stable as far as the series is: for p = 8 on the real interval [−4.31, 0] and
on the imaginary axis up to |z| ≤ 3.39. Not symplectic.
Source: À. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order Taylor
methods, Experimental Mathematics 14 (2005) 99–117.
"""

from __future__ import annotations

from ..method import Method, Series

METHOD = Method("taylor", order=8, scheme=Series(8), error_order=8)
