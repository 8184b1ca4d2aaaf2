"""Shortest paths along edges."""

from numba import njit


@njit(cache=True)
def shorten(
    offsets, neighbours, lengths, distances, owners, queue, size, waiting
):  # pragma: no cover - compiled
    """Carry distances on along edges wherever that shortens them, and with them who they are measured from.

    First in, first out: on meshes of even edges hardly a vertex is visited twice, and there is no heap to keep.
    Exact for any lengths.

    Parameters
    ----------
    offsets, neighbours, lengths : arrays
        The graph in compressed rows: the neighbours of vertex i and the lengths of the edges to them are at
        ``offsets[i]:offsets[i + 1]``. Symmetric, lengths not negative.
    distances : (n,) float64 array
        Upper bounds, changed in place.
    owners : (n,) int32 array
        The source of each distance, changed in place.
    queue : (n,) int32 array
        The first ``size`` are the vertices to start at, each once; overwritten.
    waiting : (n,) bool array
        All False, before and after.
    """
    count = len(distances)
    for position in range(size):
        waiting[queue[position]] = True
    head = 0
    while size > 0:
        node = queue[head]
        head = head + 1 if head + 1 < count else 0
        size -= 1
        waiting[node] = False
        walked, owner = distances[node], owners[node]
        for e in range(offsets[node], offsets[node + 1]):
            other = neighbours[e]
            through = walked + lengths[e]
            if through < distances[other]:
                distances[other] = through
                owners[other] = owner
                if not waiting[other]:
                    waiting[other] = True
                    tail = head + size
                    queue[tail if tail < count else tail - count] = other
                    size += 1
