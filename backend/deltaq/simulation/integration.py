"""From a method's scheme to the kernel that runs it: one case for each family."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, singledispatch

import numpy as np
from numpy.typing import NDArray

from ..model.pushes import Places, Pushes
from ..model.recurrences import nudged
from .constraints import Finish, block, solved_in
from .kernels.compiler import KernelCalls
from .kernels.constraints import constrained_motion, constrained_phase
from .kernels.explicit_runge_kutta import integrate
from .kernels.implicit_runge_kutta import integrate_implicit
from .kernels.implicit_workspace import make_implicit_workspace
from .kernels.kicked import Kicked, make_kicked
from .kernels.loop import Result
from .kernels.motion import Motion
from .kernels.newmark import integrate_newmark
from .kernels.newmark_step import NewmarkWeights, make_newmark_workspace
from .kernels.phase import Phase
from .kernels.pushed import Pushed, make_pushed
from .kernels.rattle import make_held
from .kernels.solved import constrained_finish
from .kernels.split_step import SplitWeights, make_split_workspace
from .kernels.splitting import integrate_split
from .kernels.step import make_workspace
from .kernels.step_control import Control
from .kernels.switch import Switch, make_switch
from .kernels.system import SIGNS, block_size
from .kernels.taylor import Addresses, begin_series, integrate_series, make_series
from .kernels.taylor import Series as SeriesArrays
from .kernels.watch import NODES, NODES_OF_SERIES, Watch, make_watch, unwatched
from .method import Newmark, Partitioned, Scheme, Series, Tableau
from .problem import Floats, Problem
from .series.engine import jet_of_model
from .series.single import single, told_of
from .weights import explicit_weights, implicit_weights, numbers

Flag = NDArray[np.int64]  # one number; anything but 0 ends the run


@dataclass(frozen=True)
class KernelArguments:
    """What every kernel is given: the right-hand side, how to step, what to watch for, and where samples belong.

    out[i] becomes the state at times[i], as far as the run comes: `times` has shape (samples,), `out` (samples, width).
    Whether the run `is_long` decides how its code is compiled, and `in_symbols` whether constraints are kept by what is
    solved for in symbols; series need to know their order, and whether they are nudged. Kernels that are run for each
    stretch between events are so by `call`.
    """

    problem: Problem
    motion: Motion
    control: Control
    watch: Watch
    times: Floats
    out: Floats
    is_long: bool
    in_symbols: bool
    order: int | None
    is_nudged: bool
    call: KernelCalls


@singledispatch
def run_kernel(scheme: object, _arguments: KernelArguments) -> Result:
    """Runs the kernel of a scheme. Raises TypeError for a scheme of an unknown family."""
    raise TypeError(f"no kernel is known for {type(scheme).__name__}")


@run_kernel.register
def _explicit(scheme: Tableau, arguments: KernelArguments) -> Result:
    weights = explicit_weights(scheme)
    workspace = make_workspace(arguments.problem.state, weights)
    given = arguments.motion, weights, arguments.control, arguments.watch, workspace, arguments.times, arguments.out
    found: Result = arguments.call(integrate, *given)
    return found


@run_kernel.register
def _partitioned(scheme: Partitioned, arguments: KernelArguments) -> Result:
    problem = arguments.problem
    if is_split(scheme, problem):
        return _split(scheme, arguments)
    phase, count, kicked = phase_of(problem, is_long=arguments.is_long), 0, None
    if is_kicked(scheme, problem):
        phase, count = free_phase_of(problem), problem.model.layout.holonomic
        kicked = kicked_of(scheme, problem) if arguments.in_symbols else None
    workspace = make_implicit_workspace(problem.state, problem.degrees, scheme.stages, count, kicked)
    weights = implicit_weights(scheme)
    return integrate_implicit(
        arguments.motion, phase, weights, arguments.control, arguments.watch, workspace, arguments.times, arguments.out
    )


def is_split(scheme: Partitioned, problem: Problem) -> bool:
    """Whether positions and momenta can be advanced in turn: with constraints in a single drift, if all have a g."""
    is_single = not problem.is_constrained or sum(drift != 0 for drift in scheme.drifts) == 1
    return bool(scheme.kicks) and problem.model.phase.is_separable and problem.model.layout.is_holonomic and is_single


def is_kicked(scheme: Scheme, problem: Problem) -> bool:
    """Whether constraints are kept by kicks between the steps, so that a symplectic method stays one.

    That is of order 2, and not worth it where the method's own order is higher. Constraints of rates leave nothing
    symplectic to be kept, and their reactions belong into the stages: at the ends of steps alone they are of order 1.
    """
    if not isinstance(scheme, Partitioned) or not (problem.is_constrained and problem.model.layout.is_holonomic):
        return False
    return scheme.is_symplectic and (scheme.stages == 1 or bool(scheme.kicks))


def compile_symbols(scheme: Scheme, problem: Problem) -> None:
    """Compiles what keeps constraints in the kernel of a scheme, so that no run has it in its time."""
    if isinstance(scheme, Partitioned) and problem.is_constrained:
        if is_split(scheme, problem):
            pushes_of(problem)
        elif is_kicked(scheme, problem):
            kicked_of(scheme, problem)


def kicked_of(scheme: Partitioned, problem: Problem) -> Kicked | None:
    """What corrects a single stage on constraints as solved for in symbols, where there is a solution."""
    n, m = problem.degrees, len(problem.model.layout.multipliers)
    found = problem.model.kicks if scheme.stages == 1 and problem.rank == m else None
    return None if found is None else make_kicked(found.addresses, np.array(problem.parameters), n, m)


def _split(scheme: Partitioned, arguments: KernelArguments) -> Result:
    problem = arguments.problem
    weights = SplitWeights(numbers(scheme.kicks), numbers(scheme.drifts))
    is_held, is_long = problem.is_constrained, arguments.is_long
    memory = block(problem, is_long=is_long) if is_held else np.zeros(block_size(0, 0, 0, 0, 0))
    workspace = make_split_workspace(problem.state, problem.degrees)
    return integrate_split(
        arguments.motion,
        free_phase_of(problem),
        (weights, make_held(memory, weights.kicks, weights.drifts), pushed_of(arguments)),
        arguments.control,
        arguments.watch,
        workspace,
        arguments.times,
        arguments.out,
    )


def pushes_of(problem: Problem) -> Pushes | None:
    """What is solved for in symbols, where there is a solution, and all multipliers are unique."""
    return problem.model.pushes if 0 < problem.rank == len(problem.model.layout.multipliers) else None


def pushed_of(arguments: KernelArguments) -> Pushed:
    """What keeps kicks and drifts on constraints as solved for in symbols, if wanted and there is a solution."""
    problem, model = arguments.problem, arguments.problem.model
    n, m, inputs = problem.degrees, len(model.layout.multipliers), model.motion.inputs
    found = pushes_of(problem) if arguments.in_symbols else None
    if found is None:
        return make_pushed((0, 0, 0, 0), np.zeros(1 + Places(0, 0).size), 0, 0, 0)
    given = np.zeros(inputs + Places(n, m).size)
    given[2 * n + 1 : inputs] = problem.parameters
    return make_pushed((*found.shifts.addresses, *found.ends.addresses), given, n, m, inputs)


@run_kernel.register
def _newmark(scheme: Newmark, arguments: KernelArguments) -> Result:
    weights = NewmarkWeights(float(scheme.beta), float(scheme.gamma))
    workspace = make_newmark_workspace(arguments.problem.state, arguments.problem.degrees)
    return integrate_newmark(
        arguments.motion, weights, arguments.control, arguments.watch, workspace, arguments.times, arguments.out
    )


@run_kernel.register
def _series(scheme: Series, arguments: KernelArguments) -> Result:
    problem = arguments.problem
    jet = jet_of_model(problem.model, is_long=arguments.is_long)
    recurrences, state, parameters = problem.model.recurrences, problem.state, problem.parameters
    constants = problem.model.latest("constants", parameters, lambda: recurrences.constants(np.array(parameters)))
    if arguments.is_nudged:
        constants, state = recurrences.nudged(constants), nudged(state)
    tolerance = arguments.control.tolerance
    order = arguments.order or scheme.order_for(tolerance)
    spare: list[SeriesArrays] = problem.model.kept(("spare", jet.code.address, order), list)
    try:
        series = spare.pop()  # others may ask at the same time
    except IndexError:
        steps = single().addresses
        addresses = Addresses(jet.code.address, steps["advance"], steps["measure"])
        sizes = (2 * problem.degrees, len(recurrences.conditions), jet.shape.components, jet.work)
        series = make_series(addresses, (order, *jet.program), state.size, constants.size, sizes)
    begin_series(series, told_of(order, tolerance), state, constants)
    result = integrate_series(
        arguments.motion, series, arguments.control, arguments.watch, arguments.times, arguments.out
    )
    spare.append(series)
    return result


def motion_of(problem: Problem, *, is_long: bool = True, finish: Finish = Finish.DERIVATIVE) -> Motion:
    """The right-hand side of a problem for kernels, in code for long runs or code that is compiled quickly.

    `finish` is what is asked for at the end of a step.
    """
    motion = problem.model.thorough if is_long else problem.model.motion
    address, data = motion.addresses
    inputs = np.zeros(motion.inputs)
    inputs[2 * problem.degrees + 1 :] = problem.parameters
    powered, outputs = problem.model.layout.is_powered, np.zeros(motion.outputs)
    conditioning = np.array((1.0,))
    found = Motion(address, data, problem.degrees, powered, inputs, outputs, conditioning, 0, 0, 0, _no_memory())
    if not problem.is_constrained:
        return found
    memory = block(problem, is_long=is_long, finish=finish)
    general, place = constrained_motion.address, memory.ctypes.data
    address, data = solved_in(memory) or (general, place)
    return found._replace(
        address=address, data=data, general=general, finish=constrained_finish.address, block=place, memory=memory
    )


class Workspace:
    """What runs of one model by one method read and write that follow one another: made by the first, used by all.

    Each has other parameters, being in another mode. Those with constraints or switching functions get their own.
    """

    def __init__(self) -> None:
        self.call = KernelCalls()
        self._motions: dict[bool, Motion] = {}
        self._watch: Watch | None = None

    def motion(self, problem: Problem, *, is_long: bool, finish: Finish) -> Motion:
        """See `motion_of`."""
        found = self._motions.get(is_long)
        if found is None or problem.is_constrained:
            found = self._motions[is_long] = motion_of(problem, is_long=is_long, finish=finish)
        found.inputs[2 * problem.degrees + 1 :] = problem.parameters
        found.conditioning[0] = 1.0
        return found

    def watch(self, problem: Problem, flag: Flag, scheme: Scheme) -> Watch:
        """See `watch_of`."""
        found = self._watch
        if found is None or found.functions == 0 or problem.model.switches is not None:
            self._watch = watch_of(problem, flag, scheme)
            return self._watch
        found.inputs[2 * problem.degrees + 1 :] = problem.parameters
        for each in (found.times, found.states, found.values, found.closest_times, found.closest_states):
            each.fill(0.0)
        found.least.fill(np.inf)
        return found


@cache
def _no_memory() -> Floats:
    """That of motions without constraints: nobody reads it, or writes there."""
    return np.zeros(1)


def watch_of(problem: Problem, flag: Flag, scheme: Scheme | None = None) -> Watch:
    """What may end a run of a problem by a scheme, for kernels: the flag, shape (1,), events, and friction."""
    function = problem.model.events
    if function is None and problem.model.switches is None:
        return Watch(flag, *_nothing_watched()[1:])
    switch = _switch_of(problem)
    if function is None:
        return unwatched(flag, switch)
    nodes = NODES_OF_SERIES if isinstance(scheme, Series) else NODES
    inputs = np.zeros(function.inputs)
    inputs[2 * problem.degrees + 1 :] = problem.parameters
    return make_watch(flag, function.addresses, function.outputs, inputs, problem.state.size, switch, nodes)


@cache
def _no_switch() -> Switch:
    """For motions without friction: nothing is written to these arrays."""
    return make_switch((0, 0), 0, np.zeros(1), 0)


@cache
def _nothing_watched() -> Watch:
    """For motions without events and friction: nothing is written to these arrays."""
    return unwatched(np.zeros(1, dtype=np.int64))


def _switch_of(problem: Problem) -> Switch:
    """Where forces jump with the rates, for kernels."""
    function = problem.model.switches
    if function is None:
        return _no_switch()
    inputs = np.zeros(function.inputs)
    inputs[2 * problem.degrees + 1 :] = problem.parameters
    return make_switch(function.addresses, function.outputs, inputs, problem.state.size)


def phase_of(problem: Problem, *, is_long: bool = True) -> Phase:
    """Momenta and their rates of a problem, reactions included, for kernels; in code as `motion_of` has it."""
    found = free_phase_of(problem)
    if not problem.is_constrained:
        return found
    memory, model = block(problem, is_long=is_long, with_phase=True), problem.model
    held = model.phase.held if problem.rank == len(model.layout.multipliers) else None
    general, place = constrained_phase.address, memory.ctypes.data
    if held is None:
        return found._replace(address=general, data=place, memory=memory)
    (address, data), outputs = held.addresses, np.zeros(found.outputs.size + SIGNS)
    return found._replace(address=address, data=data, outputs=outputs, general=general, block=place, memory=memory)


def free_phase_of(problem: Problem) -> Phase:
    """The same without the reactions of constraints."""
    function = problem.model.phase.function
    address, data = function.addresses
    inputs = np.zeros(function.inputs)
    inputs[2 * problem.degrees + 1 :] = problem.parameters
    return Phase(address, data, problem.degrees, inputs, np.zeros(function.outputs), 0, 0, np.zeros(1))
