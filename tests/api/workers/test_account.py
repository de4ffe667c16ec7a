"""Shares of computing time."""

from __future__ import annotations

import pytest

from deltaq.api.workers import account
from deltaq.api.workers.account import FREE, Account, Ledger, QuotaExceeded


class Clock:
    """A time that is set."""

    def __init__(self) -> None:
        self.now = 1000.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.mark.parametrize(
    ("paid", "waited", "seconds"),
    [
        pytest.param(10.0, 0.0, None, id="all of the credit"),
        pytest.param(11.0, 0.0, 2.0, id="a second more"),
        pytest.param(30.0, 0.0, 40.0, id="much more"),
        pytest.param(30.0, 30.0, 10.0, id="some is paid back"),
        pytest.param(30.0, 40.0, None, id="enough is paid back"),
    ],
)
def test_admission(clock: Clock, paid: float, waited: float, seconds: float | None) -> None:
    one = Account("one", Ledger(0.5, 10.0, clock))
    one.pay(paid)
    clock.now += waited
    if seconds is None:
        one.admit()
        return
    with pytest.raises(QuotaExceeded) as caught:
        one.admit()
    assert (caught.value.client, caught.value.seconds) == ("one", pytest.approx(seconds))


def test_one_does_not_pay_for_the_other(clock: Clock) -> None:
    ledger = Ledger(0.5, 10.0, clock)
    Account("one", ledger).pay(1000.0)
    Account("other", ledger).admit()


def test_who_may_use_what_he_likes() -> None:
    FREE.pay(1e9)
    FREE.admit()


def test_clients_without_debts_are_forgotten(clock: Clock, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(account, "MOST_CLIENTS", 10)
    ledger = Ledger(0.5, 10.0, clock)
    ledger.charge("debtor", 1000.0)
    for number in range(100):
        ledger.charge(str(number), 1.0)
        clock.now += 3.0
    assert len(ledger._debts) <= 11
    assert ledger.debt("debtor") == pytest.approx(1000.0 - 150.0)
