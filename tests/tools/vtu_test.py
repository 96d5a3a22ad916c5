"""What VTK reads from .vtu files is what Espalier wrote: vtu_test.py ESPALIER VTU_SAMPLES.

VTK evaluates its Bézier hexahedra by its own code; a point in the wrong place of its order would
show at once. Needs Debian's python3-vtk9, so /usr/bin/python3.
"""

import csv
import glob
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

from vtkmodules.vtkCommonCore import reference, vtkIdList
from vtkmodules.vtkCommonDataModel import (
    VTK_BEZIER_HEXAHEDRON,
    VTK_HEXAHEDRON,
    VTK_LINE,
    VTK_POLYHEDRON,
    VTK_QUAD,
    VTK_VERTEX,
)
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

ESPALIER, VTU_SAMPLES = (os.path.abspath(sys.argv.pop(1)) for _ in range(2))
TOLERANCE = 1e-12


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(path)
    reader.Update()
    assert not errors, path + ": VTK cannot read it"
    return reader.GetOutput()


def degrees(grid, cell):
    return tuple(int(n) for n in grid.GetCellData().GetHigherOrderDegrees().GetTuple(cell))


def value(cell, uvw):
    x = [0.0, 0.0, 0.0]
    cell.EvaluateLocation(reference(0), uvw, x, [0.0] * cell.GetNumberOfPoints())
    return x


def espalier(*words):
    return subprocess.run([ESPALIER, *words], check=True, capture_output=True, text=True).stdout


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def signed_volume(faces, points):
    """Six times the volume within faces whose loops are counter-clockwise seen from outside."""
    return sum(
        dot(points[face[0]], cross(points[face[i]], points[face[i + 1]]))
        for face in faces
        for i in range(1, len(face) - 1)
    )


def faces_of(grid, cell):
    """The faces of a polyhedron, as loops of points."""
    stream = vtkIdList()
    grid.GetFaceStream(cell, stream)
    faces, at = [], 1
    for _ in range(stream.GetId(0)):
        n = stream.GetId(at)
        faces.append([stream.GetId(at + 1 + i) for i in range(n)])
        at += n + 1
    assert at == stream.GetNumberOfIds()
    return faces


class VtuTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder.name)

    def assert_near(self, actual, expected, scale, message):
        for a, b in zip(actual, expected):
            self.assertLessEqual(abs(a - b), TOLERANCE * scale, message)

    def test_vtk_evaluates_curved_cells_as_we_do(self):
        subprocess.run([VTU_SAMPLES, "."], check=True)
        seen = set()
        for path in sorted(glob.glob("*.vtu")):
            grid = read(path)
            self.assertEqual(
                {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())},
                {VTK_BEZIER_HEXAHEDRON},
            )
            weights = grid.GetPointData().GetRationalWeights()
            self.assertEqual(weights is not None, "rational" in path, path)
            scale = grid.GetLength()
            with open(path[:-4] + ".csv", newline="", encoding="ascii") as file:
                samples = list(csv.DictReader(file))
            self.assertGreater(len(samples), 0)
            for sample in samples:
                index = int(sample["cell"])
                degree = tuple(int(sample[k]) for k in "pqr")
                self.assertEqual(degrees(grid, index), degree, path)
                seen.add(degree + (weights is not None,))
                uvw = [float(sample[k]) for k in "uvw"]
                x = [float(sample[k]) for k in "xyz"]
                self.assert_near(value(grid.GetCell(index), uvw), x, scale, f"{path} {sample}")
        for degree in [(3, 3, 3), (1, 1, 3), (1, 1, 1), (1, 2, 4), (4, 1, 3), (3, 5, 2)]:
            self.assertIn(degree + (False,), seen)
        for degree in [(1, 2, 4), (4, 1, 3), (3, 5, 2)]:
            self.assertIn(degree + (True,), seen)

    def make_posed_cylinder(self):
        espalier("new", "cylinder", "--sectors", "5", "--layers", "3", "-o", "rest.json")
        with open("rest.json", encoding="ascii") as file:
            lattice = json.load(file)
        lattice["pose"] = [
            [x + 0.1 * math.sin(3 * z), y + 0.2 * x * z, z - 0.1 * y * y]
            for x, y, z in lattice["vertices"]
        ]
        with open("posed.json", "w", encoding="ascii") as file:
            json.dump(lattice, file)
        return lattice

    def test_a_converted_volume_moves_points_as_eval_does(self):
        self.make_posed_cylinder()
        espalier("convert", "posed.json", "--volume", "--rest", "-o", "rest.vtu")
        espalier("convert", "posed.json", "--volume", "-o", "posed.vtu")
        rest, posed = read("rest.vtu"), read("posed.vtu")
        cells = [i for i in range(rest.GetNumberOfCells()) if degrees(rest, i) == (3, 3, 3)]
        self.assertGreater(len(cells), 0)
        uvw = [0.375, 0.5, 0.8125]
        with open("at.csv", "w", encoding="ascii") as file:
            file.write("x,y,z\n")
            for i in cells:
                file.write(",".join(repr(c) for c in value(rest.GetCell(i), uvw)) + "\n")
        rows = list(csv.DictReader(espalier("eval", "posed.json", "--at", "at.csv").splitlines()))
        self.assertEqual(len(rows), len(cells))
        for i, row in zip(cells, rows):
            self.assertIn(row["status"], ("inside", "border"))
            x = [float(row[k]) for k in "xyz"]
            self.assert_near(value(posed.GetCell(i), uvw), x, posed.GetLength(), f"cell {i}")

    def test_control_cells_are_those_of_the_lattice(self):
        lattice = self.make_posed_cylinder()
        espalier("new", "box", "--cells", "2", "1", "1", "-o", "box.json")
        with open("box.json", encoding="ascii") as file:
            box = json.load(file)
        for name, source, key, expected_type, options in [
            ("posed.json", lattice, "pose", VTK_POLYHEDRON, []),
            ("posed.json", lattice, "vertices", VTK_POLYHEDRON, ["--rest"]),
            ("box.json", box, "vertices", VTK_HEXAHEDRON, []),
        ]:
            espalier("convert", name, *options, "-o", "cells.vtu")
            grid = read("cells.vtu")
            points = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
            self.assertEqual([list(p) for p in points], source[key])
            self.assertEqual(grid.GetNumberOfCells(), len(source["cells"]))
            for i, cell in enumerate(source["cells"]):
                self.assertEqual(grid.GetCellType(i), expected_type)
                if expected_type == VTK_POLYHEDRON:
                    faces = faces_of(grid, i)
                    self.assertGreater(signed_volume(faces, points), 0)
                else:
                    ids = [grid.GetCell(i).GetPointId(k) for k in range(8)]
                    quads = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4)]
                    quads += [(3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)]
                    faces = [[ids[k] for k in quad] for quad in quads]
                    self.assertAlmostEqual(signed_volume(faces, points), 3, 12)
                self.assertEqual(
                    {frozenset(face) for face in faces},
                    {frozenset(source["faces"][f]) for f in cell},
                )

    def corners(self, grid, cell):
        ids = grid.GetCell(cell).GetPointIds()
        return [ids.GetId(k) for k in range(ids.GetNumberOfIds())]

    def test_control_nets_of_grids_are_cells_between_neighbours(self):
        for counts, cell_type, n_cells in [
            ((3, 4, 5), VTK_HEXAHEDRON, 24),
            ((4, 1, 5), VTK_QUAD, 12),
            ((1, 4, 1), VTK_LINE, 3),
        ]:
            espalier("new", "bezier", "--counts", *map(str, counts), "-o", "bezier.json")
            with open("bezier.json", encoding="ascii") as file:
                lattice = json.load(file)
            lattice["pose"] = [[x + z * z, y, z - x * y] for x, y, z in lattice["rest"]]
            with open("bezier.json", "w", encoding="ascii") as file:
                json.dump(lattice, file)
            for options, key in [([], "pose"), (["--rest"], "rest")]:
                espalier("convert", "bezier.json", *options, "-o", "net.vtu")
                grid = read("net.vtu")
                points = [list(grid.GetPoint(i)) for i in range(grid.GetNumberOfPoints())]
                self.assertEqual(points, lattice[key])
                self.assertEqual(grid.GetNumberOfCells(), n_cells)
                seen = set()
                for i in range(n_cells):
                    self.assertEqual(grid.GetCellType(i), cell_type)
                    ids = self.corners(grid, i)
                    nu, nv, _ = counts
                    places = [(p % nu, p // nu % nv, p // nu // nv) for p in ids]
                    low = tuple(map(min, zip(*places)))
                    self.assertTrue(all(0 <= a - b <= 1 for p in places for a, b in zip(p, low)))
                    self.assertEqual(len(set(ids)), len(ids))
                    for a, b in zip(places[:4], places[1:4]):  # round a face: one step at a time
                        self.assertEqual(sum(abs(s - t) for s, t in zip(a, b)), 1)
                    seen.add(low)
                self.assertEqual(len(seen), n_cells)

    def test_control_nets_of_hierarchies_tell_levels(self):
        degree = ["--degree", "2", "2", "2"]
        espalier("new", "thb", "--counts", "5", "5", "5", *degree, "-o", "thb.json")
        box = ["0", "0", "0", "0.3333333333333333", "0.6666666666666666", "1"]
        espalier("refine", "thb.json", "--box", *box, "--level", "1", "-o", "thb.json")
        espalier("convert", "thb.json", "-o", "net.vtu")
        grid = read("net.vtu")
        with open("thb.json", encoding="ascii") as file:
            functions = [tuple(p[:4]) for p in json.load(file)["points"]]
        levels = grid.GetCellData().GetArray("Level")
        seen = {0: set(), 1: set()}
        for i in range(grid.GetNumberOfCells()):
            level = int(levels.GetTuple1(i))
            corners = [functions[k] for k in self.corners(grid, i)]
            self.assertEqual({f[0] for f in corners}, {level})
            self.assertIn(grid.GetCellType(i), (VTK_HEXAHEDRON, VTK_QUAD, VTK_LINE, VTK_VERTEX))
            if grid.GetCellType(i) == VTK_HEXAHEDRON:
                seen[level].add(min(corners))
        active = set(functions)
        for level, cells in seen.items():
            full = {
                f
                for f in functions
                if f[0] == level
                and all(
                    (level, f[1] + a, f[2] + b, f[3] + c) in active
                    for a in (0, 1)
                    for b in (0, 1)
                    for c in (0, 1)
                )
            }
            self.assertGreater(len(full), 0)
            self.assertEqual(cells, full)


if __name__ == "__main__":
    unittest.main()
