#!/usr/bin/env python3
"""Form factors of a cube by the C interface, their closure and reciprocity: standard library only.

    python3 matrix.py [path of libhemicube.so]

Exits with 0 if every row sums to 1 and A_i F_ij = A_j F_ji.
"""
import ctypes
import ctypes.util
import sys
from ctypes import POINTER, byref, c_double, c_int, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p


class SceneDesc(ctypes.Structure):
    """hc_scene_desc: the size first, all else 0 is the default."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", POINTER(c_double)),
        ("vertex_count", c_uint64),
        ("polygon_offsets", POINTER(c_uint64)),
        ("polygon_count", c_uint64),
        ("indices", POINTER(c_uint32)),
        ("index_count", c_uint64),
        ("polygon_materials", POINTER(c_uint32)),
        ("material_count", c_uint32),
        ("band_count", c_uint32),
        ("reflectance", POINTER(c_double)),
        ("exitance", POINTER(c_double)),
        ("two_sided", POINTER(c_uint8)),
        ("space_exitance", POINTER(c_double)),
    ]


def load(path):
    library = ctypes.CDLL(path)
    library.hc_version.restype = library.hc_error_text.restype = ctypes.c_char_p
    for name in ("hc_scene_release", "hc_form_factors_release"):
        getattr(library, name).argtypes = [c_void_p]
        getattr(library, name).restype = None
    return library


def check(library, code):
    if code != 0:
        raise RuntimeError(library.hc_error_text().decode())


def cube(n):
    """A cube seen from inside, n x n squares a wall: vertices and the four corners of each square."""
    vertices, squares = [], []
    for axis in range(3):
        for side in (0, 1):
            for a in range(n):
                for b in range(n):
                    corners = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)]
                    square = []
                    for u, v in corners if side == 0 else reversed(corners):
                        vertex = [0.0, 0.0, 0.0]
                        vertex[axis] = float(side)
                        vertex[(axis + 1) % 3], vertex[(axis + 2) % 3] = u / n, v / n
                        square.append(len(vertices))
                        vertices.append(vertex)
                    squares.append(square)
    return vertices, squares


def form_factors(library, vertices, polygons):
    """The form factors of all patches as a list of {column: value}."""
    flat = [x for vertex in vertices for x in vertex]
    indices = [index for polygon in polygons for index in polygon]
    offsets = [0]
    for polygon in polygons:
        offsets.append(offsets[-1] + len(polygon))
    desc = SceneDesc(struct_size=ctypes.sizeof(SceneDesc))
    desc.vertices, desc.vertex_count = (c_double * len(flat))(*flat), len(vertices)
    desc.polygon_offsets, desc.polygon_count = (c_uint64 * len(offsets))(*offsets), len(polygons)
    desc.indices, desc.index_count = (c_uint32 * len(indices))(*indices), len(indices)
    scene, factors = c_void_p(), c_void_p()
    check(library, library.hc_scene_create(byref(desc), byref(scene)))
    try:
        check(library, library.hc_form_factors_create(scene, None, byref(factors)))
        rows, columns, nonzeros = c_uint64(), c_uint64(), c_uint64()
        check(library, library.hc_form_factors_get_size(
            factors, byref(rows), byref(columns), byref(nonzeros)))
        begins = (c_uint64 * (rows.value + 1))()
        column = (c_uint32 * nonzeros.value)()
        value = (c_double * nonzeros.value)()
        check(library, library.hc_form_factors_get_csr(
            factors, rows, nonzeros, begins, column, value, None, None))
    finally:
        library.hc_form_factors_release(factors)
        library.hc_scene_release(scene)
    # With numpy: scipy.sparse.csr_matrix((value, column, begins)), without a copy.
    return [dict(zip(column[begins[i]:begins[i + 1]], value[begins[i]:begins[i + 1]]))
            for i in range(rows.value)]


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else ctypes.util.find_library("hemicube")
    if path is None:
        sys.exit("matrix.py: no libhemicube.so is installed: give its path")
    library = load(path)
    vertices, squares = cube(4)
    rows = form_factors(library, vertices, squares)  # equal areas: reciprocity is F_ij = F_ji
    closure = max(abs(sum(row.values()) - 1) for row in rows)
    reciprocity = max(abs(value - rows[j].get(i, 0.0))
                      for i, row in enumerate(rows) for j, value in row.items())
    print(f"hemicube {library.hc_version().decode()}: {len(rows)} patches, "
          f"{sum(map(len, rows))} form factors, row sums within {closure:.1e} of 1, "
          f"reciprocal within {reciprocity:.1e}")
    return 0 if closure < 1e-6 and reciprocity < 1e-5 else 1


if __name__ == "__main__":
    sys.exit(main())
