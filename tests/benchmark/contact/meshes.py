"""Meshes of small bodies as text (gmsh 2.2): the same on every machine, and irregular where that matters."""

import math
import random

# Corners of a cube, by bits of x, y, z, that form six tetrahedra with the corners 0 and 7.
KUHN = [(1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1)]


def turned(point, rotation):
    return [sum(a * b for a, b in zip(row, point)) for row in rotation]


def rotation_to_z(direction):
    """Rotation that turns a unit vector other than -z into z."""
    x, y, z = direction
    s = 1 / (1 + z)
    return [[1 - s * x * x, -s * x * y, -x], [-s * x * y, 1 - s * y * y, -y], [x, y, z]]


def random_rotation(rng):
    """By a random quaternion."""
    while True:
        w, x, y, z = (rng.gauss(0, 1) for _ in range(4))
        n = math.sqrt(w * w + x * x + y * y + z * z)
        if n > 0.1:
            break
    w, x, y, z = w / n, x / n, y / n, z / n
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def volume(corners):
    a, b, c = ([q - p for p, q in zip(corners[0], corner)] for corner in corners[1:])
    return sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3)) / 6


class Mesh:
    """Tetrahedra in volume groups, and surfaces of their faces. A body's nodes are its own."""

    def __init__(self):
        self.nodes = []
        self.elements = []  # (group, four nodes)
        self.surfaces = {}  # name -> triangles

    def grid(self, group, cells, place):
        """A body of cells of six tetrahedra. @param place  from the three indices of a node to its position"""
        first = len(self.nodes)
        counts = [n + 1 for n in cells]
        self.nodes += [place(i, j, k) for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])]

        def node(i, j, k):
            return first + i + counts[0] * (j + counts[1] * k)

        for i, j, k in ((i, j, k) for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])):
            corner = [node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) for c in range(8)]
            self.elements += [(group, self.positive([corner[0], corner[b], corner[a], corner[7]])) for a, b in KUHN]

    def positive(self, nodes):
        if volume([self.nodes[n] for n in nodes]) < 0:
            nodes[0], nodes[1] = nodes[1], nodes[0]
        return nodes

    def box(self, group, lower, upper, cells, jitter=0.0, seed=1, keep=()):
        """@param jitter  share of a cell by which nodes are moved at random, on the surface along it
        @param keep  planes (axis, coordinate) whose nodes stay on them"""
        rng = random.Random(seed)
        size = [(b - a) / n for a, b, n in zip(lower, upper, cells)]

        def place(*index):
            point = [a + s * i for a, s, i in zip(lower, size, index)]
            return [x if i in (0, n) or any(axis == c and abs(x - at) < 1e-9 for c, at in keep) else x + shift * s
                    for axis, (x, i, n, s) in enumerate(zip(point, index, cells, size))
                    for shift in [jitter * (2 * rng.random() - 1)]]

        self.grid(group, cells, place)

    def turned_box(self, group, centre, sides, cells, rotation):
        def place(*index):
            local = [s * (i / n - 0.5) for s, i, n in zip(sides, index, cells)]
            return [c + x for c, x in zip(centre, turned(local, rotation))]

        self.grid(group, cells, place)

    def ball(self, group, centre, radius, cells):
        """A cube of cells^3 cells, each layer of which becomes a sphere."""
        def place(*index):
            local = [2 * i / cells - 1 for i in index]
            most, length = max(map(abs, local)), math.sqrt(sum(x * x for x in local))
            scale = radius * most / length if length > 0 else 0
            return [c + scale * x for c, x in zip(centre, local)]

        self.grid(group, [cells] * 3, place)

    def tetrahedron(self, group, corners):
        first = len(self.nodes)
        self.nodes += corners
        self.elements.append((group, self.positive(list(range(first, first + 4)))))

    def surface(self, name, holds):
        """Faces all of whose nodes hold. @param holds  position -> bool"""
        faces = {}
        for _, nodes in self.elements:
            for skipped in range(4):
                face = [n for i, n in enumerate(nodes) if i != skipped]
                if all(holds(self.nodes[n]) for n in face):
                    faces[tuple(sorted(face))] = face
        assert faces, name
        self.surfaces[name] = list(faces.values())

    def text(self):
        groups = sorted({group for group, _ in self.elements})
        names = [f'3 {n} "{group}"' for n, group in enumerate(groups, 1)]
        names += [f'2 {n} "{name}"' for n, name in enumerate(self.surfaces, 1 + len(groups))]
        cells = [f"4 2 {n} {n} " + " ".join(str(1 + c) for c in nodes) for group, nodes in self.elements
                 for n in [1 + groups.index(group)]]
        for n, faces in enumerate(self.surfaces.values(), 1 + len(groups)):
            cells += [f"2 2 {n} {n} " + " ".join(str(1 + c) for c in face) for face in faces]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
        lines += ["$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames"]
        lines += ["$Nodes", str(len(self.nodes))]
        lines += [f"{n} {x:.12g} {y:.12g} {z:.12g}" for n, (x, y, z) in enumerate(self.nodes, 1)]
        lines += ["$EndNodes", "$Elements", str(len(cells))]
        lines += [*(f"{n} {cell}" for n, cell in enumerate(cells, 1)), "$EndElements"]
        return "\n".join(lines) + "\n"
