"""Machine code of kernels, made by Numba: this module is loaded where some is needed, and not before.

Loading Numba takes longer than most motions.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from pickle import UnpicklingError
from types import CodeType, FunctionType
from typing import Any, NoReturn

from numba import njit
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.core.ccallback import CFunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.compiler_machinery import register_pass
from numba.core.registry import CPUDispatcher
from numba.core.sigutils import normalize_signature
from numba.core.typed_passes import NativeLowering

from ...ownership import require_trusted
from .marks import mark, name_of, source_stamp

LOGGER = logging.getLogger("deltaq.simulation")
Function = Callable[..., Any]
# Sums may be fused with products, and are not reordered; kernels have no references to count.
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "_nrt": False, "fastmath": {"contract"}}
NO_WRAPPERS: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}


def compiled_kernel(function: Function) -> Any:
    """A function compiled by Numba when it is first called, kept on disk, run without the interpreter's lock.

    Kernels allocate nothing, so they need no reference counting; without it (`_nrt`) a right-hand side takes a quarter
    of the time, since each array passed on would cost two atomic operations. The cache is beside the source, or in
    the user's cache directory where that is not writable.
    """
    made: Any = njit(cache=True, forceinline=False, pipeline_class=KernelCompiler, **OPTIONS)(linked(function))
    _kept(made._cache, function)  # noqa: SLF001 - Numba offers no other way
    return made


@cache
def compiled_part(function: Function, *, is_inlined: bool) -> PartDispatcher:
    """A part of kernels, known to the kernels alone; always inlined, or always called."""
    options = OPTIONS | NO_WRAPPERS | {"nopython": True, "forceinline": is_inlined}
    return PartDispatcher(linked(function), {}, options, PartCompiler)


def compiled_callback(function: Function, signature: str) -> Any:
    """A function of a fixed signature that has an `address`, compiled at once or read from disk."""
    arguments, returned = normalize_signature(signature)  # type: ignore[no-untyped-call]
    made: Any = CFunc(linked(function), (arguments, returned), {}, OPTIONS)
    files: Any = FunctionCache
    made._cache = _kept(files(function), function)  # noqa: SLF001
    made.compile()
    return made


def linked(function: Function) -> Function:
    """The function with machine code in the place of all the parts that it names, which may also be interpreted."""
    own = function.__globals__
    named = {name: own[name] for name in _names(function.__code__) if hasattr(own.get(name), "in_machine_code")}
    parts = {name: part.in_machine_code() for name, part in named.items()}
    made = FunctionType(
        function.__code__, {**own, **parts}, function.__name__, function.__defaults__, function.__closure__
    )
    made.__qualname__, made.__module__ = function.__qualname__, function.__module__
    made.__kwdefaults__, made.__doc__ = function.__kwdefaults__, function.__doc__
    return made


def _names(code: CodeType) -> set[str]:
    """What a function names, those that are defined in it included."""
    inner = (constant for constant in code.co_consts if isinstance(constant, CodeType))
    return {*code.co_names, *(name for each in inner for name in _names(each))}


def _kept(cache: Any, function: Function) -> Any:
    """The cache of a function, with files that are renewed with all that it is made of.

    Numba looks for changes in the function's own file only, and would keep a kernel whose inner functions changed.
    """
    file = Path(function.__code__.co_filename)
    base = cache._impl.filename_base  # noqa: SLF001
    cache._cache_file = OwnFiles(cache.cache_path, base, source_stamp(file), name_of(function))  # noqa: SLF001
    cache._guard_against_spurious_io_errors = _without_cache_errors  # noqa: SLF001
    return cache


class KernelCompiler(Compiler):
    """Numba's compiler, which is heard: it takes seconds."""

    def compile_extra(self, function: Function) -> Any:
        """Numba's result of compiling the function; raises what Numba raises."""
        LOGGER.info("compiling %s for this machine, once", function.__name__)
        return super().compile_extra(function)  # type: ignore[no-untyped-call]


class PartLibrary(JITCodeLibrary):
    """The code of a part: an intermediate representation for the kernels that it is linked into, no machine code.

    Numba would optimize a part with all its own parts and make machine code of them, and again in whatever it is a
    part of.
    """

    def _optimize_final_module(self) -> None:
        cheap: dict[str, Any] = {"loop_vectorize": False, "slp_vectorize": False, "opt": 0, "cost": "cheap"}
        codegen: Any = self._codegen
        manager, passes = codegen._module_pass_manager(**cheap)  # noqa: SLF001 - as Numba's own library does first
        manager.run(self._final_module, passes)

    def _finalize_final_module(self) -> None:
        """What Numba does before it hands the module to the machine."""
        self._finalize_dynamic_globals()  # type: ignore[no-untyped-call]
        self._verify_declare_only_symbols()  # type: ignore[no-untyped-call]
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)  # type: ignore[no-untyped-call]
class PartLowering(NativeLowering):
    """Numba's lowering of a function that is declared to its callers, though there is no machine code to be called."""

    _name = "part_lowering"

    def run_pass(self, state: Any) -> bool:
        """Leaves in the state what `NativeLowering` does, with a mere name in the place of the entry point."""
        state.flags.no_compile = True
        super().run_pass(state)  # type: ignore[no-untyped-call]
        if not state.flags.forceinline:
            state.library.get_function(state.cr.fndesc.mangled_name).add_function_attribute("noinline")
        name = object()
        state.cr = state.cr._replace(cfunc=name)
        state.targetctx.insert_user_function(name, state.cr.fndesc, [state.library])
        return True


class PartCompiler(Compiler):
    """Numba's compiler, with a library and a lowering as parts have them."""

    def compile_extra(self, function: Function) -> Any:
        """Numba's result of compiling the function; raises what Numba raises."""
        codegen = self.state.targetctx.codegen()
        self.state.library = PartLibrary(codegen, function.__qualname__)  # type: ignore[no-untyped-call]
        return super().compile_extra(function)  # type: ignore[no-untyped-call]

    def define_pipelines(self) -> list[Any]:
        """The usual passes but for the lowering."""
        (passes,) = super().define_pipelines()  # type: ignore[no-untyped-call]
        passes.passes = [(PartLowering if one is NativeLowering else one, told) for one, told in passes.passes]
        passes.finalize()
        return [passes]


class PartDispatcher(CPUDispatcher):
    """Compiles a part for each set of argument types that a kernel calls it with."""

    def add_overload(self, compiled: Any) -> None:
        """Known to the kernels alone."""
        self.overloads[tuple(compiled.signature.args)] = compiled

    def __call__(self, *_arguments: object) -> NoReturn:
        """Raises TypeError: there is no machine code of its own."""
        raise TypeError(f"{self.py_func.__name__} is a part of kernels, and cannot be called from Python")


class OwnFiles(IndexDataCacheFile):
    """Numba's files of a kernel, pickles and machine code: nothing is read that others may have written."""

    def __init__(self, folder: str, base: str, stamp: str, name: str = "") -> None:
        super().__init__(folder, base, stamp)  # type: ignore[no-untyped-call]  # as are all of Numba's
        self.folder, self.name = Path(folder), name

    def save(self, key: Any, data: Any) -> None:
        """Keeps a kernel, and leaves a mark that it is there."""
        super().save(key, data)  # type: ignore[no-untyped-call]
        mark(self.name)

    def load(self, key: Any) -> Any:
        """The kernel, None if it is not kept; one that another version has kept gets its mark."""
        found = super().load(key)  # type: ignore[no-untyped-call]
        if found is not None:
            mark(self.name)
        return found

    def _load_index(self) -> Any:
        """What is kept of the kernel; nothing where that speaks of classes which the source no longer has.

        Raises UntrustedFileError, also before anything is written.
        """
        for place in (self.folder, self.folder / self._index_name):
            with suppress(FileNotFoundError):
                require_trusted(place)
        try:
            return super()._load_index()  # type: ignore[no-untyped-call]
        except (AttributeError, ImportError):
            return {}

    def _load_data(self, name: str) -> Any:
        require_trusted(self.folder / name)
        return super()._load_data(name)  # type: ignore[no-untyped-call]


@contextmanager
def _without_cache_errors() -> Iterator[None]:
    """A kernel that cannot be kept, or not be read, is compiled anew: a full disk costs time, not the simulation."""
    try:
        yield
    except (OSError, EOFError, UnpicklingError) as error:
        _warn(type(error).__name__)


@cache
def _warn(what: str) -> None:
    """Said once for each kind: there are many kernels."""
    LOGGER.warning("kernels cannot be kept on disk, and are compiled in each process: %s", what)
