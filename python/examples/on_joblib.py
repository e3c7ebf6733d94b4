"""A study on joblib's workers: python on_joblib.py study.toml results/study"""

import sys

import joblib

import pellicle as pl

if __name__ == "__main__":
    # Without `return_as`, results are returned and written only after the last case.
    parallel = joblib.Parallel(n_jobs=-1, return_as="generator_unordered")
    print(pl.study(sys.argv[1]).map(parallel, out=sys.argv[2], progress=True))
