"""A solved case: its loading steps and its curve."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, overload

from . import show
from .curve import Curve
from .errors import NotCertifiedWarning
from .fields import Fields, SolvedFields, StoredFields
from .judgement import ResultWarning
from .step import Step

if TYPE_CHECKING:
    from ._pellicle import Solution
    from .case import Case


class Path(Sequence[Step]):
    """The loading steps of a solved case, in the order of its loads."""

    def __init__(self, case: Case, summary: dict[str, Any], curve: Curve, fields: Fields, is_whole: bool) -> None:
        self.case = case
        """The case as it was given."""
        self.summary = summary
        """The numbers of the run, as `summary.json` has them."""
        self.curve = curve
        """The columns of `curve.csv` as arrays; `pandas.DataFrame(path.curve)` is a table of them."""
        self.is_whole = is_whole
        """Whether everything that the case asks for is here; otherwise it was interrupted."""
        self._fields = fields

    @property
    def status(self) -> str:
        """The worst status of the steps: `"certified"`, `"cut-off"` or `"not-converged"`."""
        status: str = self.summary["status"]
        return status

    @cached_property
    def warnings(self) -> list[ResultWarning]:
        """Doubts about the numbers."""
        return [ResultWarning(**warning) for warning in self.summary["warnings"]]

    def __len__(self) -> int:
        return len(self.summary["steps"])

    @overload
    def __getitem__(self, index: int) -> Step: ...
    @overload
    def __getitem__(self, index: slice) -> list[Step]: ...
    def __getitem__(self, index: int | slice) -> Step | list[Step]:
        found = range(len(self))[index]
        return [self._step(i) for i in found] if isinstance(found, range) else self._step(found)

    def __iter__(self) -> Iterator[Step]:
        return map(self._step, range(len(self)))

    def _step(self, index: int) -> Step:
        is_si = "force [N]" in self.curve
        return Step(self.summary["steps"][index], self.summary["grid"], index, self._fields, is_si)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Path):
            return NotImplemented
        return self.case == other.case and list(self) == list(other)

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> Path:
        return self

    def __deepcopy__(self, memo: object) -> Path:
        return self

    def __reduce__(self) -> tuple[type[Path], tuple[Any, ...]]:
        radii = {step.index: step.contact_radius for step in self}
        stored = StoredFields.of(self._fields, range(len(self)), self.summary["grid"]["side"], radii)
        return Path, (self.case, self.summary, self.curve, stored, self.is_whole)

    def __repr__(self) -> str:
        steps = f"{len(self)} step{'' if len(self) == 1 else 's'}"
        return f"<Path {self.case.title!r}: {steps}, {self.status}>"

    def _repr_html_(self) -> str:
        names = [name for name, _ in show.step_rows(self[0])] if len(self) else []
        return show.table(names, [[value for _, value in show.step_rows(step)] for step in self])


def path_of(case: Case, solution: Solution) -> Path:
    """The path of a solution; warns if it is not certified."""
    summary = json.loads(solution.summary())
    curve = Curve.of_csv(solution.curve())
    path = Path(case, summary, curve, SolvedFields(solution, case), solution.is_whole)
    if path.status != "certified":
        reasons = [str(warning) for warning in path.warnings if warning.code == path.status]
        message = "; ".join([f"the solution is {path.status}, do not use these numbers", *reasons])
        warnings.warn(message, NotCertifiedWarning, stacklevel=3)
    return path
