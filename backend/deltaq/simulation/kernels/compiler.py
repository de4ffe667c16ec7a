"""How kernels are compiled."""

from __future__ import annotations

import ast
import hashlib
import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache, cached_property
from pathlib import Path
from pickle import UnpicklingError
from typing import Any, NoReturn, TypeVar, cast

from numba import njit
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.core.ccallback import CFunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.compiler_machinery import register_pass
from numba.core.registry import CPUDispatcher
from numba.core.typed_passes import NativeLowering

from ...ownership import require_trusted

LOGGER = logging.getLogger("deltaq.simulation")
F = TypeVar("F", bound=Callable[..., object])
# Sums may be fused with products, and are not reordered; kernels have no references to count.
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "_nrt": False, "fastmath": {"contract"}}
NO_WRAPPERS: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}


def kernel(function: F) -> F:
    """A function compiled by Numba, kept on disk, run without the interpreter's lock; sums are not reordered.

    Kernels allocate nothing, so they need no reference counting; without it (`_nrt`) a right-hand side takes a quarter
    of the time, since each array passed on would cost two atomic operations. The cache is beside the source, or in
    the user's cache directory where that is not writable.
    """
    compiled: Any = njit(cache=True, forceinline=False, pipeline_class=KernelCompiler, **OPTIONS)(function)
    _kept(compiled._cache, function)  # noqa: SLF001 - Numba offers no other way
    return cast("F", compiled)


def subroutine(function: F) -> F:
    """A part of kernels that is always called: too large to be there more than once. Only kernels can call it."""
    return _part(function, forceinline=False)


def inline(function: F) -> F:
    """A part of kernels that is always inlined, since a call would pass seven words for each array."""
    return _part(function, forceinline=True)


def _part(function: F, *, forceinline: bool) -> F:
    options = OPTIONS | NO_WRAPPERS | {"nopython": True, "forceinline": forceinline}
    return cast("F", PartDispatcher(function, {}, options, PartCompiler))


class Callback:
    """A function with a fixed signature that machine code calls by its address; compiled when first asked for."""

    def __init__(self, function: Callable[..., object], signature: Any) -> None:
        self._function, self._signature = function, signature

    @cached_property
    def address(self) -> int:
        """Where the machine code is, as long as the process lives."""
        arguments, returned = self._signature.args, self._signature.return_type
        compiled: Any = CFunc(self._function, (arguments, returned), {}, OPTIONS)
        files: Any = FunctionCache
        compiled._cache = _kept(files(self._function), self._function)  # noqa: SLF001
        compiled.compile()
        self._kept = compiled
        return int(compiled.address)


def callback(signature: Any) -> Callable[[Callable[..., object]], Callback]:
    """A function that machine code calls by its address: a compiled model made around another, say."""

    def wrapped(function: Callable[..., object]) -> Callback:
        return Callback(function, signature)

    return wrapped


def _kept(cache: Any, function: Callable[..., object]) -> Any:
    """The cache of a function, with files that are renewed with all that it is made of.

    Numba looks for changes in the function's own file only, and would keep a kernel whose inner functions changed.
    """
    stamp = source_stamp(Path(function.__code__.co_filename))
    base = cache._impl.filename_base  # noqa: SLF001
    cache._cache_file = OwnFiles(cache.cache_path, base, stamp)  # noqa: SLF001
    cache._guard_against_spurious_io_errors = _without_cache_errors  # noqa: SLF001
    return cache


class KernelCompiler(Compiler):
    """Numba's compiler, which is heard: it takes seconds."""

    def compile_extra(self, function: Callable[..., object]) -> Any:
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

    def compile_extra(self, function: Callable[..., object]) -> Any:
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

    def __init__(self, folder: str, base: str, stamp: str) -> None:
        super().__init__(folder, base, stamp)  # type: ignore[no-untyped-call]  # as are all of Numba's
        self.folder = Path(folder)

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


@cache
def source_stamp(file: Path) -> str:
    """A digest of the code of a module and of all modules of the package that it imports."""
    digest, seen, left = hashlib.sha256(), set[Path](), [file]
    while left:
        module = left.pop()
        if module not in seen:
            seen.add(module)
            left += _imported(module)
            digest.update(module.read_bytes())
    return digest.hexdigest()


@cache
def _imported(file: Path) -> tuple[Path, ...]:
    """The modules of the package that a module names in its imports; read once, for most kernels rest on the same."""
    found = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level > 0:
            folder = file.parents[node.level - 1].joinpath(*(node.module or "").split("."))
            found |= {folder.with_suffix(".py"), *(folder / f"{alias.name}.py" for alias in node.names)}
    return tuple(sorted((module for module in found if module.is_file()), reverse=True))


@inline
def runtime_int(number: int) -> int:
    """The number, no longer a literal: Numba compiles a function once more for each literal it is called with."""
    return int(number)
