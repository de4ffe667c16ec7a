"""What δq promises, measured once more: one table of targets, figures and the commands that tell more.

Run it from the checkout on a calm machine: `python -m tests.benchmarks.bench_targets`; it takes about seven minutes,
two of them for the honesty of the estimate. Peers that are not installed are left out by name. Medians. Prints;
judges nothing but each figure against its target.
"""

from __future__ import annotations

from tests.benchmarks import targets_of_model, targets_of_service

MODEL = (
    targets_of_model.models,
    targets_of_model.derivations,
    targets_of_model.right_hand_side,
    targets_of_model.accuracy,
    targets_of_model.cold_start,
)
SERVICE = (
    targets_of_service.before_the_first_plot,
    targets_of_service.pages,
    targets_of_service.load,
    targets_of_service.hostile,
)


def main() -> None:
    print("| what | target | figure | | command |\n|---|---|---|---|---|")
    for group in (*MODEL, *SERVICE, targets_of_model.estimates):
        for target in group():
            print(target, flush=True)


if __name__ == "__main__":
    main()
