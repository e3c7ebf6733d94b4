"""A study on a Dask cluster, whose workers may die and restart: python on_dask.py study.toml results/study"""

import sys

from distributed import Client, LocalCluster

import pellicle as pl

if __name__ == "__main__":
    # Or SLURMCluster, KubeCluster and others, or Client("tcp://scheduler:8786").
    with LocalCluster(threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        print(pl.study(sys.argv[1]).map(client, out=sys.argv[2], progress=True))
