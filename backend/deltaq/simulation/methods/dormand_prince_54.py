"""Dormand–Prince 5(4): the usual choice for middling accuracy.

Order 5 with an embedded order 4 for the step size, six stages and the slope at the end, which the next step reuses;
error constants of the order 5 solution minimized. Stable on the imaginary axis up to |z| ≤ 1 and on the real
interval [−3.307, 0]. Continuous extension of order 4. Not symplectic.
Source: J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19–26; extension: Hairer, Nørsett, Wanner I, II.6.
"""

from __future__ import annotations

from ..method import Method, Tableau, row, rows

A = """
-
1/5
3/40 9/40
44/45 -56/15 32/9
19372/6561 -25360/2187 64448/6561 -212/729
9017/3168 -355/33 46732/5247 49/176 -5103/18656
"""
B = "35/384 0 500/1113 125/192 -2187/6784 11/84"
C = "0 1/5 3/10 4/5 8/9 1"
ERROR = "71/57600 0 -71/16695 71/1920 -17253/339200 22/525 -1/40"
DENSE = """
-12715105075/11282082432 0 87487479700/32700410799 -10690763975/1880347072
701980252875/199316789632 -1453857185/822651844 69997945/29380423
"""

METHOD = Method(
    "dormand-prince-54",
    order=5,
    scheme=Tableau(a=rows(A), b=row(B), c=row(C), error=rows(ERROR), dense=(row(DENSE),)),
    error_order=5,
    memory=0.04,
)
