"""Contact of an indenter with a layered, textured elastic body: solved and certified.

>>> import pellicle as pl
>>> body = pl.Foundation(pl.Material("3 GPa", 0.35), [pl.Layer("2 um", pl.Material("200 GPa", 0.25))])
>>> case = pl.Case(body, pl.Sphere("0.5 mm"), force="5 mN", elements=64)
>>> path = case.solve()
>>> path.status
'certified'
>>> path[-1].pressure.shape
(64, 64)
"""

from ._pellicle import __version__
from .body import Foundation, Grading, Layer, Material, Spring
from .case import Case, Path
from .curve import Curve
from .errors import (
    ArgumentError,
    CaseError,
    ContactError,
    Error,
    FitWarning,
    IdentifyError,
    IndenterError,
    InfluenceError,
    InternalError,
    KernelError,
    NotCertifiedWarning,
    RunError,
    StudyWarning,
    TextureError,
)
from .estimates import Expected, ExpectedDesign, FitEstimate, KnownCombination
from .evaluation import Evaluation, evaluate
from .fit import Design, Fit, Nuisances, Report, Unknown
from .function import IndenterFunction, ReliefFunction
from .height_map import HeightMap
from .identification import EachCurve, Identification, Plan, identify, identify_each, plan
from .indenter import (
    Berkovich,
    Cone,
    CubeCorner,
    Flat,
    FlatPunch,
    Indenter,
    IndenterMap,
    Paraboloid,
    PowerLaw,
    Pyramid,
    Sphere,
    Vickers,
)
from .judgement import Certificate, Estimate, GridError, ResultWarning, Sensitivity, Work
from .likelihood import Likelihood
from .measurement import Baseline, Data, Noise, Segment, SpringConstant, Text, Uncertain
from .oliver_pharr import KnownBody, OliverPharr
from .operator import ElasticOperator, compliance, influence_coefficients
from .options import Output, Range, Stress, Wear
from .parameter_study import Study, StudyTable, study
from .problem import DiscreteProblem, Judgement
from .progress import FitProgress, Progress, SearchProgress, StudyProgress
from .quantity import Quantity
from .search import Found, find
from .step import Step
from .stresses import StressFields
from .surface import Bare, Cylinders, Dimples, Film, Grooves, ReliefMap, Rough, Surface
from .waiting import Interrupted

__all__ = [
    "ArgumentError",
    "Bare",
    "Baseline",
    "Berkovich",
    "Case",
    "CaseError",
    "Certificate",
    "Cone",
    "ContactError",
    "CubeCorner",
    "Curve",
    "Cylinders",
    "Data",
    "Design",
    "Dimples",
    "DiscreteProblem",
    "EachCurve",
    "ElasticOperator",
    "Error",
    "Estimate",
    "Evaluation",
    "Expected",
    "ExpectedDesign",
    "Film",
    "Fit",
    "FitEstimate",
    "FitProgress",
    "FitWarning",
    "Flat",
    "FlatPunch",
    "Found",
    "Foundation",
    "Grading",
    "GridError",
    "Grooves",
    "HeightMap",
    "Identification",
    "IdentifyError",
    "Indenter",
    "IndenterError",
    "IndenterFunction",
    "IndenterMap",
    "InfluenceError",
    "InternalError",
    "Interrupted",
    "Judgement",
    "KernelError",
    "KnownBody",
    "KnownCombination",
    "Layer",
    "Likelihood",
    "Material",
    "Noise",
    "NotCertifiedWarning",
    "Nuisances",
    "OliverPharr",
    "Output",
    "Paraboloid",
    "Path",
    "Plan",
    "PowerLaw",
    "Progress",
    "Pyramid",
    "Quantity",
    "Range",
    "ReliefFunction",
    "ReliefMap",
    "Report",
    "ResultWarning",
    "Rough",
    "RunError",
    "SearchProgress",
    "Segment",
    "Sensitivity",
    "Sphere",
    "Spring",
    "SpringConstant",
    "Step",
    "Stress",
    "StressFields",
    "Study",
    "StudyProgress",
    "StudyTable",
    "StudyWarning",
    "Surface",
    "Text",
    "TextureError",
    "Uncertain",
    "Unknown",
    "Vickers",
    "Wear",
    "Work",
    "__version__",
    "compliance",
    "evaluate",
    "find",
    "identify",
    "identify_each",
    "influence_coefficients",
    "plan",
    "study",
]
