"""Engines: objects that run a function on many arguments, locally or on a cluster."""

from __future__ import annotations

import queue
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Protocol, TypeAlias, TypeVar

from .errors import ArgumentError

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

TURN = 0.2
"""Seconds between two checks of signals while no task finishes."""


class Submits(Protocol):
    """An executor of `concurrent.futures`, a Dask client, and others that return futures."""

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Any:
        """A future of the function's result, with `add_done_callback`, `cancel` and `result`."""
        ...


class Maps(Protocol):
    """A pool of `multiprocessing` or Ray, and others."""

    def map(self, function: Callable[..., Any], tasks: Iterable[Any], /) -> Iterable[Any]:
        """The function's results, in the order of the tasks."""
        ...


class Calls(Protocol):
    """A `joblib.Parallel`."""

    def __call__(self, calls: Iterable[Any], /) -> Iterable[Any]:
        """The results of functions with arguments, as `joblib.delayed` writes them."""
        ...


Engine: TypeAlias = Submits | Maps | Calls
"""Anything with `submit` or `map`, or a `joblib.Parallel`."""


def outcomes(engine: Any, function: Callable[[Task], Outcome], tasks: Sequence[Task]) -> Iterator[Outcome]:
    """Yields the function's result for each task as soon as the engine returns it, in any order.

    A failing task does not stop the others: the first failure is raised at the end.
    """
    if hasattr(engine, "submit"):
        return _submitted(engine, function, tasks)
    # In order of completion, if the pool supports it.
    for name in ("imap_unordered", "map"):
        if hasattr(engine, name):
            return iter(getattr(engine, name)(function, tasks))
    if callable(engine):
        return iter(engine((function, (task,), {}) for task in tasks))
    wanted = "an object with submit or map, or a joblib.Parallel"
    raise ArgumentError(f"executor: found {type(engine).__name__}, wanted {wanted}")


def _submitted(engine: Submits, function: Callable[[Task], Outcome], tasks: Sequence[Task]) -> Iterator[Outcome]:
    ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
    pending: set[Any] = set()
    failure: Exception | None = None
    try:
        for task in tasks:
            try:
                future = engine.submit(function, task)
            except Exception as error:  # The engine is broken: what it has ended is still good.
                failure = error
                break
            pending.add(future)
            future.add_done_callback(ended.put)
        while pending:
            try:
                future = ended.get(timeout=TURN)
            except queue.Empty:
                continue
            pending.remove(future)
            try:
                outcome = future.result()
            except Exception as error:
                failure = failure or error
            else:
                yield outcome
    finally:
        for future in pending:
            future.cancel()
    if failure is not None:
        raise failure
