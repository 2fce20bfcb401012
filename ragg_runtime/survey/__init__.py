"""Many flights: each diagnosed by itself, on a pool of processes or a Dask cluster, and summarised."""
