"""A study on local processes: python processes.py study.toml results/study"""

import sys
from concurrent.futures import ProcessPoolExecutor

import pellicle as pl

if __name__ == "__main__":
    with ProcessPoolExecutor() as pool:
        print(pl.study(sys.argv[1]).map(pool, out=sys.argv[2], progress=True))
