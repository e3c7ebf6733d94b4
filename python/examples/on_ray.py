"""A study on a Ray cluster, whose workers may die and restart: python on_ray.py study.toml results/study"""

import sys
from concurrent.futures import Future

import ray

import pellicle as pl


@ray.remote
def call(function, *arguments):
    return function(*arguments)


class Ray:
    """Ray tasks as futures."""

    def submit(self, function, /, *arguments) -> Future:
        return call.remote(function, *arguments).future()


if __name__ == "__main__":
    ray.init()
    print(pl.study(sys.argv[1]).map(Ray(), out=sys.argv[2], progress=True))
