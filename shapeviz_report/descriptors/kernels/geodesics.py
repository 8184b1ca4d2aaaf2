"""Shortest paths along edges from farthest-point sources."""

import numpy as np
from numba import njit


@njit(cache=True)
def walk_from_sources(offsets, neighbours, lengths, first, source_count):  # pragma: no cover - compiled
    """Distances from ``source_count`` sources, each the vertex farthest from those before it.

    Parameters
    ----------
    offsets, neighbours, lengths : arrays
        The graph in compressed rows: the neighbours of vertex i and the lengths of the edges to them are at
        ``offsets[i]:offsets[i + 1]``. Connected, symmetric, lengths not negative.
    first : int
        The first source.

    Returns
    -------
    mean : (n,) float64 array
        Average of the distances to the sources, each weighted by the number of vertices nearest to it.
    sources : (source_count,) int64 array
    """
    count = len(offsets) - 1
    distances = np.empty((source_count, count))
    nearest = np.full(count, np.inf)
    owner = np.zeros(count, np.int64)
    sources = np.empty(source_count, np.int64)
    heap_keys = np.empty(len(neighbours) + 1)
    heap_nodes = np.empty(len(neighbours) + 1, np.int32)
    source = first
    for s in range(source_count):
        sources[s] = source
        distance = distances[s]
        distance[:] = np.inf
        distance[source] = 0.0
        heap_keys[0] = 0.0
        heap_nodes[0] = source
        size = 1
        while size > 0:
            key, node = heap_keys[0], heap_nodes[0]
            size -= 1
            last_key, last_node = heap_keys[size], heap_nodes[size]
            hole = 0
            while True:
                child = 2 * hole + 1
                if child >= size:
                    break
                if child + 1 < size and heap_keys[child + 1] < heap_keys[child]:
                    child += 1
                if heap_keys[child] >= last_key:
                    break
                heap_keys[hole] = heap_keys[child]
                heap_nodes[hole] = heap_nodes[child]
                hole = child
            heap_keys[hole] = last_key
            heap_nodes[hole] = last_node
            if key > distance[node]:
                continue
            for e in range(offsets[node], offsets[node + 1]):
                other = neighbours[e]
                through = key + lengths[e]
                if through < distance[other]:
                    distance[other] = through
                    hole = size
                    size += 1
                    while hole > 0:
                        parent = (hole - 1) // 2
                        if heap_keys[parent] <= through:
                            break
                        heap_keys[hole] = heap_keys[parent]
                        heap_nodes[hole] = heap_nodes[parent]
                        hole = parent
                    heap_keys[hole] = through
                    heap_nodes[hole] = other
        farthest = -1.0
        for v in range(count):
            if distance[v] < nearest[v]:
                nearest[v] = distance[v]
                owner[v] = s
            if nearest[v] > farthest:
                farthest = nearest[v]
                source = v
    weights = np.zeros(source_count)
    for v in range(count):
        weights[owner[v]] += 1.0 / count
    mean = np.zeros(count)
    for s in range(source_count):
        for v in range(count):
            mean[v] += weights[s] * distances[s, v]
    return mean, sources
