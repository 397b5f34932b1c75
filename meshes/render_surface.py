"""For render.py: the surface of fragments, by the neighbours of their elements."""
import math

import numpy as np

FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])  # of a tetrahedron of positive volume, normals outwards
SHARP = math.cos(math.radians(40))  # faces that meet at a larger angle form an edge that is drawn


def point_numbers(points, neighbour, ids):
    """The same number for corners that were one before anything broke: those of faces that elements share, each with the
    nearest one across. Places alone would not tell, as a run that goes on from another one begins strained.
    neighbour: (num_elements, 4) id of the element across the face opposite to a corner, negative: none"""
    place = np.searchsorted(ids, neighbour)
    element, opposite = np.nonzero((neighbour >= 0) & (place < len(ids)))
    across = place[element, opposite]
    numbers = np.arange(4 * len(points))
    pairs = []
    for step in (1, 2, 3):
        corner = (opposite + step) % 4
        distance = np.linalg.norm(points[across] - points[element, corner][:, None], axis=2)
        pairs.append((4 * element + corner, 4 * across + distance.argmin(axis=1)))
    one, other = (np.concatenate(side) for side in zip(*pairs))
    while True:  # the lowest number spreads
        lowest = np.minimum(numbers[one], numbers[other])
        spread = numbers.copy()
        np.minimum.at(spread, one, lowest)
        np.minimum.at(spread, other, lowest)
        spread = spread[spread]
        if np.array_equal(spread, numbers):
            return numbers.reshape(-1, 4)
        numbers = spread


def outer_faces(numbers, fragment):
    """(num_elements, 4) True for the faces that no other element of the same fragment shares.
    numbers: of the elements' corners, see point_numbers."""
    corners = np.sort(numbers[:, FACES], axis=2).reshape(-1, 3)
    key = np.column_stack((corners, np.repeat(fragment, 4)))
    order = np.lexsort(key.T)
    same = np.all(np.diff(key[order], axis=0) == 0, axis=1)
    outer = np.empty(len(key), dtype=bool)
    outer[order] = ~(np.concatenate((same, [False])) | np.concatenate(([False], same)))
    return outer.reshape(-1, 4)


def edges_between(numbers, points, surface, fragment):
    """Edges of surface faces along which the fragment changes, and those where the surface has a sharp bend.
    Each as (elements, ends): an edge from corner ends[:, 0] to ends[:, 1] of an element, once for either side."""
    elements, faces = np.nonzero(surface)
    corners = FACES[faces]
    x = points[elements[:, None], corners]
    normal = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    ends = np.stack((corners, np.roll(corners, -1, axis=1)), axis=2).reshape(-1, 2)
    face = np.repeat(np.arange(len(faces)), 3)
    element = elements[face]
    key = np.sort(numbers[element[:, None], ends], axis=1)
    order = np.lexsort(key.T)
    same = np.all(np.diff(key[order], axis=0) == 0, axis=1)
    one, other = order[:-1][same], order[1:][same]
    parted = fragment[element[one]] != fragment[element[other]]
    bent = np.einsum("ij,ij->i", normal[face[one]], normal[face[other]]) < SHARP
    both = [np.concatenate((one[chosen], other[chosen])) for chosen in (parted, bent & ~parted)]
    return [(element[chosen], ends[chosen]) for chosen in both]
