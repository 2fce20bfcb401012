"""Many flights: each diagnosed separately, on a pool of processes or a Dask cluster, and summarised."""
